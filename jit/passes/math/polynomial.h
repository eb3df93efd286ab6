#pragma once

#include <array>
#include <cstddef>

#include "runtime/value/value.h"

namespace nacre {

/// c[0] + c[1] x + ... by Horner's rule, one fma a coefficient after the first:
/// the fewest operations, which is what counts where other lanes hide latency.
template <std::size_t N>
Float polynomial(Float x, const std::array<float, N>& c) {
  Float sum = c[N - 1];
  for (std::size_t i = N - 1; i-- > 0;) sum = fma(sum, x, c[i]);
  return sum;
}

/// The coefficients times `factor`.
template <std::size_t N>
constexpr std::array<float, N> scaled(std::array<float, N> c, float factor) {
  for (float& each : c) each *= factor;
  return c;
}

}  // namespace nacre
