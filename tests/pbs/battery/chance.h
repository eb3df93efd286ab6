#pragma once

#include <cmath>
#include <nacre/lobe_test/chi_square.hpp>

namespace nacre {

/// What counts as a fault where chance decides, so that all comparisons of a family together fail
/// by chance with probability 1e-3: Sidak, "Rectangular Confidence Regions for the Means of
/// Multivariate Normal Distributions", JASA 62(318), 1967.
struct Chance {
  /// `comparisons`: of the whole family, which is all that one test program draws.
  explicit Chance(double comparisons) : level(level_of_one(comparisons)) {
    // By halving: erfc falls, and 40 deviations are out of reach.
    double low = 0.0, high = 40.0;
    for (int i = 0; i < 100; ++i) {
      const double middle = 0.5 * (low + high);
      (std::erfc(middle * std::sqrt(0.5)) > level ? low : high) = middle;
    }
    deviations = high;
  }

  double level;       ///< A smaller probability is a fault.
  double deviations;  ///< A normal error of more standard deviations, to either side, is a fault.
};

}  // namespace nacre
