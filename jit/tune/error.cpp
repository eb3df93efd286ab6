#include "jit/tune/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace nacre {

namespace {

std::string_view group_of(std::string_view channel) {
  return channel.substr(0, channel.rfind('.'));
}

/// The largest magnitude of each group of channels.
std::map<std::string, double, std::less<>> peaks_of(const Columns& exact) {
  std::map<std::string, double, std::less<>> peaks;
  for (const auto& [name, column] : exact) {
    double& peak = peaks[std::string(group_of(name))];
    for (const float x : column) {
      if (std::isfinite(x)) peak = std::max(peak, std::abs(double(x)));
    }
  }
  return peaks;
}

double distance(float found, float exact, double least) {
  if (found == exact) return 0;
  if (!std::isfinite(found)) return std::numeric_limits<double>::infinity();
  const double off = std::abs(double(found) - double(exact));
  return least > 0 ? off / std::max(std::abs(double(exact)), least) : off;
}

}  // namespace

Error error_of(const Columns& found, const Columns& exact, const Metric& metric) {
  const auto peaks = peaks_of(exact);
  Error error;
  std::vector<double> all;
  for (const auto& [name, column] : exact) {
    const auto given = found.find(name);
    const double least = metric.is_relative ? metric.floor * peaks.find(group_of(name))->second : 0;
    for (std::size_t i = 0; i < column.size(); ++i) {
      if (!std::isfinite(column[i])) continue;
      const double off = distance(given != found.end() ? given->second[i] : NAN, column[i], least);
      all.push_back(off);
      error.mean += off;
      if (off <= error.maximum) continue;
      error.maximum = off;
      error.worst = name;
      error.worst_point = i;
    }
  }
  if (all.empty()) return error;
  error.mean /= static_cast<double>(all.size());
  const auto rank = static_cast<std::ptrdiff_t>(0.999 * static_cast<double>(all.size() - 1));
  std::ranges::nth_element(all, all.begin() + rank);
  error.p999 = all[static_cast<std::size_t>(rank)];
  return error;
}

}  // namespace nacre
