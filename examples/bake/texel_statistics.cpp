#include "examples/bake/texel_statistics.h"

#include <algorithm>
#include <cmath>

namespace nacre::host {

namespace {

/// Side by side, so that the compiler can do them at once.
constexpr std::size_t lanes = 8;

void count_others(const std::vector<float>& plane, ChannelStatistics& channel) {
  for (const float value : plane) {
    if (std::isnan(value)) ++channel.no_number;
    if (std::isinf(value)) ++channel.unbounded;
  }
  channel.finite -= channel.no_number + channel.unbounded;
}

void add_range(const std::vector<float>& plane, ChannelStatistics& channel) {
  std::array<float, lanes> least, most;
  std::array<double, lanes> sum{};
  least.fill(channel.least);
  most.fill(channel.most);
  const auto add = [&](std::size_t lane, float value) {
    least[lane] = value < least[lane] ? value : least[lane];
    most[lane] = value > most[lane] ? value : most[lane];
    sum[lane] += static_cast<double>(value);
  };
  std::size_t i = 0;
  for (; i + lanes <= plane.size(); i += lanes) {
    for (std::size_t lane = 0; lane < lanes; ++lane) add(lane, plane[i + lane]);
  }
  for (; i < plane.size(); ++i) add(i % lanes, plane[i]);
  channel.least = *std::min_element(least.begin(), least.end());
  channel.most = *std::max_element(most.begin(), most.end());
  for (const double part : sum) channel.sum += part;
  channel.finite = plane.size();
  if (std::isfinite(channel.sum)) return;
  count_others(plane, channel);
  channel.sum = 0.0;
  for (const float value : plane) channel.sum += std::isfinite(value) ? double(value) : 0.0;
}

/// The part of the histogram that each number is of; `bins + 2` for what is not finite.
void find_bins(const float* values, std::size_t count, const StatisticsRequest& request,
               std::int32_t* found) {
  constexpr auto bins = static_cast<std::int32_t>(ChannelStatistics::bins);
  constexpr auto last = static_cast<float>(bins - 1);
  const float scale = static_cast<float>(bins) / (request.to - request.from);
  // Without a branch, so that the compiler can do several at once.
  for (std::size_t i = 0; i < count; ++i) {
    const float value = values[i];
    const float place = (value - request.from) * scale;
    const float kept = place > 0.0f ? (place < last ? place : last) : 0.0f;
    std::int32_t bin = 1 + static_cast<std::int32_t>(kept);
    bin = place < 0.0f ? 0 : bin;
    bin = place >= 0.0f && value > request.to ? bins + 1 : bin;
    found[i] = std::fabs(value) <= std::numeric_limits<float>::max() ? bin : bins + 2;
  }
}

void add_histogram(const std::vector<float>& plane, const StatisticsRequest& request,
                   ChannelStatistics& channel) {
  constexpr std::size_t at_once = 256;
  constexpr std::size_t tables = 4;  // Neighbours often are of one part: each has its own counts.
  std::array<std::int32_t, at_once> found;
  std::array<std::array<std::uint32_t, ChannelStatistics::bins + 3>, tables> counts{};
  for (std::size_t begin = 0; begin < plane.size(); begin += at_once) {
    const std::size_t count = std::min(at_once, plane.size() - begin);
    find_bins(plane.data() + begin, count, request, found.data());
    for (std::size_t i = 0; i < count; ++i) {
      ++counts[i % tables][static_cast<std::size_t>(found[i])];
    }
  }
  for (const auto& table : counts) {
    for (std::size_t bin = 0; bin < channel.histogram.size(); ++bin) {
      channel.histogram[bin] += table[bin];
    }
  }
}

}  // namespace

bool TexelStatistics::is_uniform() const {
  return std::all_of(channels.begin(), channels.end(), [](const ChannelStatistics& channel) {
    return channel.least == channel.most;
  });
}

void TexelStatistics::add(const TexelStatistics& other) {
  texels += other.texels;
  samples += other.samples;
  unfinished += other.unfinished;
  shading_seconds += other.shading_seconds;
  if (channels.empty()) channels.resize(other.channels.size());
  for (std::size_t c = 0; c < other.channels.size(); ++c) {
    ChannelStatistics& mine = channels[c];
    const ChannelStatistics& theirs = other.channels[c];
    mine.least = std::min(mine.least, theirs.least);
    mine.most = std::max(mine.most, theirs.most);
    mine.sum += theirs.sum;
    mine.finite += theirs.finite;
    mine.unbounded += theirs.unbounded;
    mine.no_number += theirs.no_number;
    for (std::size_t i = 0; i < mine.histogram.size(); ++i)
      mine.histogram[i] += theirs.histogram[i];
  }
}

TexelStatistics statistics_of(std::span<const std::vector<float>> planes,
                              const StatisticsRequest& request) {
  TexelStatistics statistics;
  statistics.texels = planes.empty() ? 0 : planes[0].size();
  for (const std::vector<float>& plane : planes) {
    ChannelStatistics& channel = statistics.channels.emplace_back();
    add_range(plane, channel);
    if (request.histogram) add_histogram(plane, request, channel);
  }
  return statistics;
}

}  // namespace nacre::host
