#include "examples/render/distribution.h"

#include <algorithm>

namespace nacre::host {

namespace {

/// Intervals that share an entry of the guide: their edges are in one line of the cache.
constexpr std::size_t intervals_of_entry = 4;
/// Edges that are looked at together.
constexpr std::size_t counted = 8;

}  // namespace

Distribution::Distribution(const std::vector<double>& weights) {
  for (const double w : weights) sum_ += w;
  double running = 0;
  edges_.push_back(0.f);
  for (const double w : weights) {
    running += w;
    edges_.push_back(sum_ > 0 ? static_cast<float>(running / sum_) : 0.f);
  }
  if (sum_ > 0) edges_.back() = 1.f;
  last_ = weights.size() - 1;

  const std::size_t entries = (weights.size() + intervals_of_entry - 1) / intervals_of_entry;
  std::uint32_t interval = 0;
  for (std::size_t k = 0; k < entries; ++k) {
    const float begin = static_cast<float>(k) / static_cast<float>(entries);
    while (interval + 1 < weights.size() && edges_[interval + 1] <= begin) ++interval;
    guide_.push_back(interval);
  }
  guide_.push_back(static_cast<std::uint32_t>(last_));
  edges_.insert(edges_.end(), counted, 2.f);
}

Distribution::Choice Distribution::choose(float u) const {
  u = std::min(u, 0x1.fffffep-1f);
  const std::size_t entry = entry_of(u);
  std::size_t i = guide_[entry];
  // The product may have been rounded up to an entry that begins beyond u.
  while (i > 0 && edges_[i] > u) --i;
  if (guide_[entry + 1] <= i + counted) {
    // No branch depends on where it is: edges that are not beyond u.
    std::size_t passed = 0;
    for (std::size_t k = 1; k <= counted; ++k) passed += edges_[i + k] <= u ? 1 : 0;
    i = std::min(i + passed, last_);  // Where nothing is any wide, all are passed.
  } else {
    const float* const first = edges_.data() + i;
    i += static_cast<std::size_t>(std::upper_bound(first + 1, edges_.data() + last_ + 1, u) -
                                  (first + 1));
  }
  while (i < last_ && edges_[i + 1] <= u) ++i;
  const float span = edges_[i + 1] - edges_[i];
  const float within = span > 0.f ? std::min((u - edges_[i]) / span, 0x1.fffffep-1f) : 0.5f;
  return {static_cast<int>(i), within};
}

float Distribution::probability(int interval) const {
  const auto i = static_cast<std::size_t>(interval);
  return edges_[i + 1] - edges_[i];
}

}  // namespace nacre::host
