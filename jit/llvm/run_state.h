#pragma once

#include <atomic>
#include <cstdint>

#include "runtime/kernel.h"

namespace nacre {

/// What compiled code gets: the host's arguments, and what ends a run early. Code that can
/// take too many steps writes to `steps_left`, all functions of a Program to the same.
struct RunState {
  KernelArguments arguments;  ///< `stop` and `fitted` are not null.
  std::int64_t max_steps = 0;
  /// Of the pass; below zero, until the run ends, once there were too many.
  std::int64_t steps_left = 0;
};

/// At the beginning of a run. `max_steps`: of a pass; the code counts to 2^62 at most.
RunState first_state(const KernelArguments& arguments, std::uint64_t max_steps);

}  // namespace nacre
