#include "tests/pbs/battery/closure_trial.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/pbs/battery/closure_laws.h"
#include "tests/pbs/battery/closure_points.h"

namespace nacre {

namespace {

constexpr std::size_t points_at_once = 4096;

/// Whether all laws hold at the points of one seed.
bool try_seed(const ClosureCase& row, const std::vector<Setting>& form,
              const ClosureKernels& kernels, std::uint64_t seed, std::size_t count) {
  const Arrays points = hostile_points(kernels.inputs, seed, count);
  const std::vector<ClosureFault> faults = try_laws(kernels, points, count);
  for (const ClosureFault& fault : faults) {
    ADD_FAILURE() << row.nodedef << " " << to_string(form) << " " << to_string(kernels.way) << ": "
                  << fault.law << ", at " << fault.count << " of " << count
                  << " points, first at point " << fault.first << " of seed " << seed << ": "
                  << fault.found << "\n"
                  << describe_point(points, fault.first);
  }
  return faults.empty();
}

}  // namespace

void try_closure(const ClosureCase& row, const ClosureWay& way, std::size_t points,
                 std::uint64_t seed) {
  for (const std::vector<Setting>& form : row.forms) {
    const ClosureKernels kernels = compile_closure(row, form, way);
    ASSERT_TRUE(kernels.material || kernels.values) << kernels.diagnostics.to_string();
    std::size_t left = points / row.forms.size();
    for (std::uint64_t number = seed; left > 0; ++number) {
      const std::size_t count = std::min(left, points_at_once);
      if (!try_seed(row, form, kernels, number, count)) break;
      left -= count;
    }
  }
}

}  // namespace nacre
