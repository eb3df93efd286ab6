#include "examples/bake/sample_set.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace nacre::host {

namespace {

/// The binary digits of `i` behind the point, in reverse.
double radical_inverse(std::uint32_t i) {
  double value = 0.0;
  for (double digit = 0.5; i != 0; i >>= 1, digit *= 0.5) {
    if ((i & 1u) != 0) value += digit;
  }
  return value;
}

}  // namespace

std::vector<SamplePlace> sample_places(int count) {
  std::vector<SamplePlace> places;
  const bool is_power = std::has_single_bit(static_cast<unsigned>(count));
  const double step = 1.0 / count;
  for (int i = 0; i < count; ++i) {
    const double turns = (i - 0.5 * (count - 1)) * (std::numbers::phi - 1.0) + 0.5;
    const double y = is_power ? radical_inverse(static_cast<std::uint32_t>(i)) + 0.5 * step
                              : turns - std::floor(turns);
    places.push_back({static_cast<float>((i + 0.5) * step), static_cast<float>(y)});
  }
  return places;
}

}  // namespace nacre::host
