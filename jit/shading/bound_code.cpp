#include "jit/shading/bound_code.h"

#include "jit/llvm/run_state.h"

namespace nacre {

RunStatus BoundCode::run(const void* const* inputs, void* const* outputs,
                         std::uint64_t count) const {
  if (count % static_cast<std::uint64_t>(code.lanes) != 0) return RunStatus::wrong_arguments;
  if (count == 0) return RunStatus::done;  // The code makes one pass at least.
  RunState state = first_state(arguments, code.max_steps);
  state.arguments.inputs = inputs;
  state.arguments.outputs = outputs;
  state.arguments.count = count;
  code.entry(&state);
  return state.steps_left < 0 ? RunStatus::too_many_steps : RunStatus::done;
}

}  // namespace nacre
