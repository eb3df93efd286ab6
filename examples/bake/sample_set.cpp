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

/// Digits of a binary fraction.
constexpr int digits = 16;
constexpr std::uint32_t one = 1u << digits;

/// Sobol's second dimension.
std::uint32_t sobol(std::uint32_t i) {
  std::uint32_t value = 0;
  for (std::uint32_t v = one / 2; i != 0; i >>= 1, v ^= v >> 1) {
    if ((i & 1u) != 0) value ^= v;
  }
  return value;
}

/// Each of the first two digits that is one inverts those behind it; the shift is by a sixth.
float scrambled(std::uint32_t value) {
  for (const std::uint32_t digit : {one / 2, one / 4}) {
    if ((value & digit) != 0) value ^= digit - 1;
  }
  return (static_cast<float>(value ^ one / 6) + 0.5f) * (1.0f / static_cast<float>(one));
}

}  // namespace

std::vector<SamplePlace> sample_sequence(int count) {
  std::vector<SamplePlace> places;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i) {
    const auto x = static_cast<std::uint32_t>(radical_inverse(i) * one);
    places.push_back({scrambled(x), scrambled(sobol(i))});
  }
  return places;
}

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
