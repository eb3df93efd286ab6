#pragma once

#include <algorithm>
#include <cstddef>
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
  /// u in [0, 1); 1 is taken as the last number before it, and of no width any will do.
  Choice choose(float u) const;
  /// Fetch what choose() reads first, and what it reads after that, which has to be there.
  void fetch_guide(float u) const { __builtin_prefetch(&guide_[entry_of(u)]); }
  void fetch_edges(float u) const { __builtin_prefetch(&edges_[guide_[entry_of(u)]]); }
  float probability(int interval) const;
  double sum() const { return sum_; }  ///< Of the weights.

 private:
  std::size_t entry_of(float u) const {
    const std::size_t entries = guide_.size() - 1;
    return std::min(static_cast<std::size_t>(u * static_cast<float>(entries)), entries - 1);
  }

  std::vector<float> edges_;  ///< n + 1, from 0 to 1; and behind them some that nothing reaches.
  /// The interval where each of equal parts of [0, 1) begins, and the last one.
  std::vector<std::uint32_t> guide_;
  std::size_t last_ = 0;
  double sum_ = 0;
};

}  // namespace nacre::host
