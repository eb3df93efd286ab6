#include "jit/shading/bound_code.h"

#include <algorithm>
#include <atomic>

#include "jit/llvm/run_state.h"

namespace nacre {

namespace {

constexpr std::atomic<std::uint32_t> never = 0;

}  // namespace

RunStatus BoundCode::run(const void* const* inputs, void* const* outputs,
                         std::uint64_t count) const {
  if (count % static_cast<std::uint64_t>(code.lanes) != 0) return RunStatus::wrong_arguments;
  if (count == 0) return RunStatus::done;  // The code makes one pass at least.
  RunState state;
  state.arguments = arguments;
  state.arguments.inputs = inputs;
  state.arguments.outputs = outputs;
  state.arguments.count = count;
  state.arguments.stop = &never;
  // Below zero is what the code writes, so there is no more than this.
  state.max_steps =
      static_cast<std::int64_t>(std::min<std::uint64_t>(code.max_steps, std::uint64_t{1} << 62));
  state.steps_left = state.max_steps;
  code.entry(&state);
  return state.steps_left < 0 ? RunStatus::too_many_steps : RunStatus::done;
}

}  // namespace nacre
