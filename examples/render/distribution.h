#pragma once

#include <cstdint>
#include <vector>

namespace nacre::host {

/// A choice among n intervals of [0, 1) as wide as they are likely: the one that holds a number.
/// By inversion, so that numbers which are well spread choose well spread.
class Distribution {
 public:
  Distribution() = default;
  /// In proportion to `weights`, each at least 0; all 0: no interval is any wide.
  explicit Distribution(const std::vector<double>& weights);

  struct Choice {
    int interval;
    float within;  ///< Where in it u is, in [0, 1).
  };
  /// u in [0, 1).
  Choice choose(float u) const;
  float probability(int interval) const;
  double sum() const { return sum_; }  ///< Of the weights.

 private:
  std::vector<float> edges_;          ///< n + 1, from 0 to 1.
  std::vector<std::uint32_t> guide_;  ///< The interval where each of equal parts of [0, 1) begins.
  double sum_ = 0;
};

}  // namespace nacre::host
