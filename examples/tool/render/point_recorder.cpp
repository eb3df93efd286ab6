#include "examples/tool/render/point_recorder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "runtime/mix_bits.h"

namespace nacre::tool {

namespace {

std::uint64_t hash_of(const std::vector<std::uint32_t>& bits) {
  std::uint64_t hash = 0;
  for (const std::uint32_t each : bits) hash = mix_bits(hash + 0x9e3779b97f4a7c15u + each);
  return hash;
}

/// Leaves the channels that `other` has too, and adds its points.
void join(PointsOfMaterial& to, const PointsOfMaterial& other) {
  const auto join_columns = [](auto& columns, const auto& more) {
    std::erase_if(columns, [&](const auto& each) { return !more.contains(each.first); });
    for (auto& [name, column] : columns) {
      const auto& from = more.at(name);
      column.insert(column.end(), from.begin(), from.end());
    }
  };
  join_columns(to.floats, other.floats);
  join_columns(to.integers, other.integers);
  to.count += other.count;
}

}  // namespace

void PointRecorder::want(const Channel& channel, host::BatchSource source) {
  const bool is_wanted = std::ranges::any_of(
      wanted_, [&](const Wanted& each) { return each.channel.name == channel.name; });
  if (source && !is_wanted) wanted_.push_back({channel, std::move(source)});
}

void PointRecorder::add(const host::ShadingBatch& batch) {
  std::vector<const float*> lanes;
  for (const Wanted& each : wanted_) {
    lanes.push_back(static_cast<const float*>(each.source(batch)));
  }
  std::vector<std::uint32_t> bits(wanted_.size());
  const std::lock_guard lock(mutex_);
  for (std::uint32_t i = 0; i < batch.count; ++i) {
    bool is_finite = true;
    for (std::size_t k = 0; k < bits.size(); ++k) {
      // What a mesh does not have is 0 for its kernels too.
      const float x = lanes[k] != nullptr ? lanes[k][i] : 0.0f;
      bits[k] = std::bit_cast<std::uint32_t>(x);
      is_finite = is_finite && (wanted_[k].channel.type != Scalar::f32 || std::isfinite(x));
    }
    const std::uint64_t hash = hash_of(bits);
    const bool is_full = kept_.size() == most;
    if (!is_finite || (is_full && hash >= kept_.rbegin()->first)) continue;
    if (kept_.emplace(hash, bits).second && is_full) kept_.erase(std::prev(kept_.end()));
  }
}

PointsOfMaterial PointRecorder::points(const std::string& material) const {
  const std::lock_guard lock(mutex_);
  PointsOfMaterial made{material, kept_.size(), {}, {}};
  for (std::size_t k = 0; k < wanted_.size(); ++k) {
    const Channel& channel = wanted_[k].channel;
    for (const auto& [hash, bits] : kept_) {
      if (channel.type == Scalar::f32) {
        made.floats[channel.name].push_back(std::bit_cast<float>(bits[k]));
      } else {
        made.integers[channel.name].push_back(std::bit_cast<std::int32_t>(bits[k]));
      }
    }
  }
  return made;
}

PointsOfMaterial joined(std::vector<PointsOfMaterial> points) {
  std::erase_if(points, [](const PointsOfMaterial& each) { return each.count == 0; });
  if (points.empty()) return {};
  PointsOfMaterial all = std::move(points.front());
  for (std::size_t i = 1; i < points.size(); ++i) join(all, points[i]);
  return all;
}

}  // namespace nacre::tool
