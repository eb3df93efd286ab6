#pragma once

#include <cstdint>

#include "runtime/value/value.h"

namespace nacre {

/// x = 2^e (1 + f) for positive finite x.
struct Mantissa {
  Float f;
  Float scaled_exponent;  ///< e * 2^23: as it stands in the bits, one shift saved.
};

inline constexpr std::int32_t two_thirds_bits = 0x3f2aaaab;
inline constexpr std::int32_t sqrt_half_bits = 0x3f3504f3;

/// 1 + f is from the float of bits `least`, in (1/2, 1], to twice that: by
/// default f is in [-1/3, 1/3), as near to 0 as it gets.
inline Mantissa split_mantissa(Float x, std::int32_t least = two_thirds_bits) {
  const Int bits = bits_of(x);
  const Int exponent = (bits - Int(least)) & Int(-(1 << 23));
  return {float_of_bits(bits - exponent) - 1.0f, to_float(exponent)};
}

/// log2 by the polynomial of `standard`.
Float log2_standard(Mantissa m);

}  // namespace nacre
