#pragma once

#include <memory>
#include <span>

#include "tests/pbs/battery/lobe_case.h"
#include "tests/pbs/battery/narrow_warp.h"

namespace nacre {

/// A lobe whose `LobeInputs::roughness` is how narrow it is: alpha of facets, along the tangent; of
/// fibres the longitudinal variance. A row of the table is all that a new one needs.
struct NarrowCase {
  LobeCase lobe;
  std::unique_ptr<NarrowWarp> (*warp)(float width, Direction wo);
  std::span<const float> widths;
  std::span<const double> angles;  ///< Of wo to the normal, degrees.
  /// Of so many widths and angles the daily tier has one; 0: none.
  std::size_t daily_share = 0;
};

std::span<const NarrowCase> narrow_cases();

inline void PrintTo(const NarrowCase& row, std::ostream* out) { *out << row.lobe.name; }

}  // namespace nacre
