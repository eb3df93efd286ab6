#include "examples/bake/sample_set.h"

#include <cstdint>

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
  const double half = 0.5 / count;
  for (int i = 0; i < count; ++i) {
    // For other numbers than powers of two the strata along y have unequal sizes: the middle
    // of the whole set stays that of the texel.
    places.push_back({static_cast<float>(2 * i * half + half),
                      static_cast<float>(radical_inverse(static_cast<std::uint32_t>(i)))});
  }
  double sum = 0.0;
  for (const SamplePlace& place : places) sum += static_cast<double>(place.y);
  const double shift = 0.5 - sum / count;
  for (SamplePlace& place : places) {
    place.y = static_cast<float>(static_cast<double>(place.y) + shift);
  }
  return places;
}

}  // namespace nacre::host
