#include "jit/passes/math/coefficients.h"
#include "jit/passes/math/functions.h"
#include "jit/passes/math/polynomial.h"

namespace nacre {

namespace {

Float sin_near_zero(Angle a, Accuracy accuracy) {
  const Float square = a.rest * a.rest;
  const Float p = polynomial(square, coefficients::sin_quarter);
  // A product as the last step keeps the sign of zero.
  if (accuracy == Accuracy::standard) return a.rest * fma(square, p, 1.0f);
  // sin(r + low) = sin(r) + low cos(r).
  const Float from_low = fma(square * Float(-0.5f), a.low, a.low);
  return a.rest + fma(a.rest * square, p, from_low);
}

Float cos_near_zero(Angle a, Accuracy accuracy) {
  const Float square = a.rest * a.rest;
  if (accuracy == Accuracy::standard) {
    const Float p = polynomial(square, coefficients::cos_standard);
    return fma(square, fma(square, p, -0.5f), 1.0f);
  }
  const Float half = square * Float(-0.5f);
  const Float high = 1.0f + half;
  // What 1 - square / 2 lost, and - low sin(r).
  const Float low = fma(-a.rest, a.low, half - (high - 1.0f));
  return high + fma(square * square, polynomial(square, coefficients::cos_precise), low);
}

/// y with its sign flipped where bit `bit` of n is set.
Float flip_by_bit(Float y, Int n, int bit) { return select((n & Int(1 << bit)) == Int(0), y, -y); }

}  // namespace

Float approximate_sin(Float x, Angle a, Accuracy accuracy) {
  if (accuracy == Accuracy::fast) {
    const Float y = a.rest * polynomial(a.rest * a.rest, coefficients::sin_fast);
    return flip_by_bit(y, a.turns, 0);
  }
  const Float sine = sin_near_zero(a, accuracy);
  const Float cosine = cos_near_zero(a, accuracy);
  const Float y = select((a.turns & Int(1)) == Int(0), sine, cosine);
  const Float result = flip_by_bit(y, a.turns, 1);
  // The sums of `precise` lose the sign of zero.
  return accuracy == Accuracy::precise ? select(x == 0.0f, x, result) : result;
}

Float approximate_cos(Angle a, Accuracy accuracy) {
  if (accuracy == Accuracy::fast) {
    const Float square = a.rest * a.rest;
    return flip_by_bit(fma(square, polynomial(square, coefficients::cos_fast), 1.0f), a.turns, 0);
  }
  const Float sine = sin_near_zero(a, accuracy);
  const Float cosine = cos_near_zero(a, accuracy);
  const Float y = select((a.turns & Int(1)) == Int(0), cosine, sine);
  return flip_by_bit(y, a.turns + Int(1), 1);
}

}  // namespace nacre
