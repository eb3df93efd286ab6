#pragma once

#include <cstdint>

#include "runtime/value/value.h"

namespace nacre {

/// x = 2^e (1 + f), f in [-1/3, 1/3), for positive finite x.
struct Mantissa {
  Float f;
  Float scaled_exponent;  ///< e * 2^23: as it stands in the bits, one shift saved.
};

inline Mantissa split_mantissa(Float x) {
  constexpr std::int32_t two_thirds = 0x3f2aaaab;
  const Int bits = bits_of(x);
  const Int exponent = (bits - Int(two_thirds)) & Int(-(1 << 23));
  return {float_of_bits(bits - exponent) - 1.0f, to_float(exponent)};
}

/// log2 by the polynomial of `standard`.
Float log2_standard(Mantissa m);

}  // namespace nacre
