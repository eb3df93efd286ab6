#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "runtime/program/program.h"

namespace nacre {

/// Steps that a pass may take where nothing else is said: about 4 ms of compiled code.
inline constexpr std::uint64_t default_max_steps = 4'000'000;

/// What one pass of points through a function takes at most, in steps: roughly
/// instructions. Regions count as if some lane always took them. Doubles, since trees of
/// calls and nests of loops go beyond every integer.
struct FunctionCost {
  double straight = 0;  ///< Outside of loops, that of what is called there included.
  double once = 0;      ///< With every loop running one round.
  double most = 0;      ///< With every loop running all the rounds that it may.
  /// By the instruction that opens a loop: a round of it, without loops inside.
  std::map<ValueId, double> rounds;
};

/// By function of the Program, whose callees stand before their callers.
std::vector<FunctionCost> function_costs(const Program& program);

/// FunctionCost::once of the instructions from `first` on; `once` has that of the functions
/// which they may call, by number.
double cost_once(const Function& function, std::size_t first, const std::vector<double>& once);

/// What engines need to end a Program in time: see RunStatus::too_many_steps.
class StepLimit {
 public:
  /// For a Program as the engine runs it.
  StepLimit(const Program& program, std::uint64_t max_steps);

  /// Whether steps must be counted while it runs; if not, it cannot take too many.
  bool is_counted() const { return is_counted_; }
  /// Whether a run can end as too_many_steps at all.
  bool can_fail() const { return can_fail_; }
  /// As given.
  std::uint64_t max_steps() const { return max_steps_; }
  /// Passes after which KernelArguments::stop is worth a look: a few milliseconds.
  std::uint64_t passes_between_looks() const { return passes_between_looks_; }

 private:
  std::uint64_t max_steps_;
  std::uint64_t passes_between_looks_;
  bool is_counted_;
  bool can_fail_;
};

}  // namespace nacre
