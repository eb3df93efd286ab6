#pragma once

#include "jit/passes/math/constants.h"
#include "runtime/value/value.h"

namespace nacre {

/// n + exponent_shift, for integers n in [-127, 128], holds the biased exponent
/// of 2^n in its low nine bits.
inline constexpr float exponent_shift = round_to_low_bits + 127.0f;

/// 2^n from n + exponent_shift: 0 for n = -127, infinity for 128. Zero for NaN,
/// so that a factor that is NaN decides.
inline Float power_of_two(Float shifted) { return float_of_bits(bits_of(shifted) << Int(23)); }

struct Exponent {
  Float value;    ///< n, at most 127.
  Float shifted;  ///< n + exponent_shift, for power_of_two().
};

/// The exponent n of 2^x = 2^n 2^r from x + exponent_shift, x >= -127.5: nearest
/// to x, but 127 above. There r passes 1/2 and 2^r goes on to overflow by
/// itself, so that no result needs a case.
inline Exponent nearest_exponent(Float x_shifted) {
  const Float shifted = min(Float(exponent_shift + 127.0f), x_shifted);
  return {shifted - exponent_shift, shifted};
}

}  // namespace nacre
