#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "examples/bake/texel_statistics.h"

namespace nacre::host {

/// Numbers that a file cannot hold, and the span of all that there were.
struct Cut {
  std::size_t count = 0;
  float least = std::numeric_limits<float>::infinity();
  float most = -std::numeric_limits<float>::infinity();

  void add(const Cut& other) {
    count += other.count;
    least = std::min(least, other.least);
    most = std::max(most, other.most);
  }
};

/// The numbers that a file holds.
struct Span {
  float least, most;
};

/// Counts what lies outside the numbers that the file holds, or is none. `known` says what there
/// is in the plane; halves have infinity and NaN.
Cut cut_of(const std::vector<float>& plane, const ChannelStatistics& known, Span held,
           bool is_half);

}  // namespace nacre::host
