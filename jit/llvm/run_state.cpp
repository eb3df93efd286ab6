#include "jit/llvm/run_state.h"

#include <algorithm>
#include <array>

namespace nacre {

namespace {

constexpr std::atomic<std::uint32_t> never = 0;

/// That nothing is fitted: no other row is read then.
alignas(64) constexpr std::array<float, std::size_t{Fit::most}> nothing_fitted{};

}  // namespace

RunState first_state(const KernelArguments& arguments, std::uint64_t max_steps) {
  RunState state;
  state.arguments = arguments;
  if (arguments.stop == nullptr) state.arguments.stop = &never;
  if (arguments.fitted == nullptr) state.arguments.fitted = nothing_fitted.data();
  // Below zero is what the code writes, so there is no more than this.
  state.max_steps =
      static_cast<std::int64_t>(std::min<std::uint64_t>(max_steps, std::uint64_t{1} << 62));
  state.steps_left = state.max_steps;
  return state;
}

}  // namespace nacre
