#pragma once

#include "runtime/value/value.h"

namespace nacre {

// What a sum over a few facets can be asked for takes no division and no root, which take most of
// its time otherwise: estimates that are the same on every CPU.

/// 1 / sqrt(x), 9e-4 of it off at most, for x from 1e-37 to 1e37; finite at 0. A guess from the
/// bits and one of Newton's steps (Lomont, "Fast Inverse Square Root", 2003). The guess is made
/// 2^(-1/3) of the root, so that the step is guess (3 2^(-2/3) - x guess^2) and needs no factor
/// besides; both constants by a search for the least error.
inline Float estimated_inverse_root(Float x) {
  const Float guess = float_of_bits(Int(0x5f0b3734) - (bits_of(x) >> Int(1)));
  return guess * fma(-(x * guess), guess, 1.8909924f);
}
/// sqrt(x) by it, of x >= 0: 9e-4 off.
inline Float estimated_root(Float x) { return x * estimated_inverse_root(x); }
/// 1 / x of x > 0, 4e-6 off: by a step of Newton's more, for what has one sign of error over a sum.
inline Float estimated_inverse(Float x) {
  const Float y = square(estimated_inverse_root(x));
  return y * fma(-x, y, 2.0f);
}

}  // namespace nacre
