#include "bench/accuracy/error.h"

#include <algorithm>
#include <cmath>

namespace nacre {

namespace {

constexpr double overflow = 0x1p+128;
constexpr double least_normal = 0x1p-126;

double ulp_of(double truth) {
  const double magnitude = std::clamp(std::fabs(truth), least_normal, 0x1p+127);
  return std::ldexp(1.0, std::ilogb(magnitude) - 23);
}

}  // namespace

double ulp_error(float got, double truth) {
  const double expected = std::clamp(truth, -overflow, overflow);
  const double value = std::clamp(static_cast<double>(got), -overflow, overflow);
  if (value == 0.0) {
    return std::max(0.0, std::fabs(expected) - least_normal) / ulp_of(expected);
  }
  return std::fabs(value - expected) / ulp_of(expected);
}

void ErrorStatistics::add(float got, double truth, std::uint32_t x, std::uint32_t y) {
  ++count;
  if (std::isnan(got) || std::isnan(truth)) {
    if (std::isnan(got) == std::isnan(truth)) return;
    if (wrong++ == 0) wrong_x = x, wrong_y = y;
    return;
  }
  const double ulps = ulp_error(got, truth);
  ulp.add(ulps, x, y);
  if (!std::isfinite(got) || !(std::fabs(truth) < overflow)) return;
  const double difference = std::fabs(static_cast<double>(got) - truth);
  absolute.add(difference, x, y);
  if (std::fabs(truth) >= least_normal) relative.add(difference / std::fabs(truth), x, y);
}

void ErrorStatistics::merge(const ErrorStatistics& other) {
  ulp.add(other.ulp);
  relative.add(other.relative);
  absolute.add(other.absolute);
  if (wrong == 0) wrong_x = other.wrong_x, wrong_y = other.wrong_y;
  wrong += other.wrong;
  count += other.count;
}

}  // namespace nacre
