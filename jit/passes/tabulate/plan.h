#pragma once

#include <vector>

#include "jit/passes/tabulate/groups.h"
#include "jit/passes/tabulate/piecewise.h"

namespace nacre {

/// Values of a group that are looked up along one axis, in the order of its functions.
struct Looked {
  ValueId key;
  std::vector<ValueId> values;
  Piecewise fitted;
  ValueId place;  ///< Of an axis that is given by a value of the group.
};

/// What to look up of a group, so that having its outputs takes the fewest operations: some of
/// them, or of what they are computed from, each along the axis that suits it. Outputs are no
/// further off than `error` (see fit_piecewise) of their values. Nothing where little would be
/// saved.
std::vector<Looked> plan_group(const Program& program, const Groups& groups, ValueId key,
                               double error);

/// The same of all groups that may save something, as far as there is time to look.
std::vector<Looked> plan_all(const Program& program, const Groups& groups, double error);

/// One of its values, of another number than its key.
Ref record_looked(Recorder& recorder, const Program& program, const Groups& groups,
                  const Looked& looked, std::size_t function, Ref number);

/// What tables save of a group must be more than that, in operations.
inline constexpr double least_saving = 12;
/// The same of fits, which take time when parameters change, and beside which code stays that
/// computes: all channels of a metal save more, a dielectric's factor less.
inline constexpr double least_saving_of_fits = 60;
inline double least_saving_of(const Groups& groups) {
  return groups.has_parameters() ? least_saving_of_fits : least_saving;
}

/// In operations: a function in straight lines over equal cells.
inline constexpr double least_cost_of_a_table = 9;

}  // namespace nacre
