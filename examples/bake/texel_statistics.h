#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace nacre::host {

/// The numbers of a channel, as computed.
struct ChannelStatistics {
  static constexpr std::size_t bins = 32;

  /// NaN does not count; infinite and NaN where there is nothing that does.
  float least = std::numeric_limits<float>::infinity();
  float most = -std::numeric_limits<float>::infinity();
  double sum = 0.0;             ///< Of the finite ones.
  std::uint64_t finite = 0;     ///< How many there are,
  std::uint64_t unbounded = 0;  ///< and of infinite ones,
  std::uint64_t no_number = 0;  ///< and NaN.
  /// Finite numbers below `from`, in `bins` equal parts up to `to`, and above it; counted if asked.
  std::array<std::uint64_t, bins + 2> histogram{};

  double mean() const { return finite == 0 ? 0.0 : sum / static_cast<double>(finite); }
};

/// What statistics are made of; see TexelStatistics.
struct StatisticsRequest {
  bool histogram = false;
  float from = 0.0f;  ///< Where the parts of the histogram begin and end.
  float to = 1.0f;
};

/// The numbers of a map's channels, and what they took.
struct TexelStatistics {
  std::vector<ChannelStatistics> channels;
  std::uint64_t texels = 0;
  std::uint64_t samples = 0;
  std::uint64_t unfinished = 0;  ///< This and the next: see BakeCounts.
  double shading_seconds = 0.0;

  /// All texels are alike; NaN is like everything.
  bool is_uniform() const;
  /// Together with another map, or part of one, of as many channels, or of what has none yet.
  void add(const TexelStatistics& other);
};

/// Of planes of texels.
TexelStatistics statistics_of(std::span<const std::vector<float>> planes,
                              const StatisticsRequest& request);

}  // namespace nacre::host
