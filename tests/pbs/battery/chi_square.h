#pragma once

#include <vector>

namespace nacre {

/// Probability that a chi-square variable of so many degrees of freedom exceeds x.
double chi_square_tail(double x, double degrees);

/// Pearson's test: the probability of counts at least as far from `expected`,
/// which is scaled to the same sum. Neighbours are pooled until 8 are expected.
double chi_square_probability(const std::vector<double>& counts,
                              const std::vector<double>& expected);

/// The level of one of `tests` so that all of them together fail by chance with
/// probability 1e-3 (Sidak 1967).
double level_of_one(double tests);

}  // namespace nacre
