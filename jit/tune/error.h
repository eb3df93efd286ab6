#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace nacre {

/// Arrays by channel, an element a point.
using Columns = std::map<std::string, std::vector<float>>;

/// What counts as how far off.
struct Metric {
  /// Of what there should be, or of `floor` times the largest of that at all points where it is
  /// less: |x - exact| / max(|exact|, floor * peak). Else |x - exact|.
  bool is_relative = true;
  double floor = 0.01;
  bool operator==(const Metric&) const = default;
};

/// Of all numbers of all channels.
struct Error {
  double mean = 0;
  double p999 = 0;  ///< What one number of a thousand exceeds.
  double maximum = 0;
  std::string worst;            ///< Channel of the maximum.
  std::size_t worst_point = 0;  ///< And its point.
};

/// How far `found` is from `exact`, channel by channel of `exact`. The components of a vector or
/// colour have one peak. What is not finite where it should be, or not there, is infinitely far
/// off; where `exact` is not finite nothing counts.
Error error_of(const Columns& found, const Columns& exact, const Metric& metric);

}  // namespace nacre
