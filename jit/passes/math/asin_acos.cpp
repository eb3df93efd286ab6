#include "jit/passes/math/coefficients.h"
#include "jit/passes/math/constants.h"
#include "jit/passes/math/double_float.h"
#include "jit/passes/math/functions.h"
#include "jit/passes/math/polynomial.h"

namespace nacre {

namespace {

/// asin of w = x where |x| <= 1/2, of w = sqrt((1 - |x|) / 2) elsewhere: there
/// asin(|x|) = pi / 2 - 2 asin(w). NaN where |x| > 1.
struct Inner {
  Bool far;  ///< |x| > 1/2.
  Float w;
  Float value;  ///< asin(w), w taken as exact.
  Float rest;   ///< asin(w) - w with what w itself lacks; `precise` only.
};

Inner inner_asin(Float x, Accuracy accuracy) {
  const Float magnitude = abs(x);
  const Bool far = magnitude > 0.5f;
  const Float square = select(far, fma(magnitude, -0.5f, 0.5f), x * x);
  const Float root = sqrt(square);
  const Float w = select(far, root, x);
  const Float cube = w * square;
  if (accuracy == Accuracy::standard) {
    return {far, w, fma(cube, polynomial(square, coefficients::asin_standard), w), 0.0f};
  }
  // One step of Newton for what the root lost; 0 at 0.
  const Float lost = fma(-root, root, square) / max(Float(0x1p-60f), root + root);
  const Float p = polynomial(square, coefficients::asin_precise);
  return {far, w, fma(cube, p, w), fma(cube, p, select(far, lost, 0.0f))};
}

/// acos(|x|) = sqrt(1 - |x|) p(|x|) (M. Abramowitz, I. Stegun, Handbook of
/// Mathematical Functions, 1964, 4.4.45, for the form).
Float root_of_fast(Float magnitude) { return sqrt(1.0f - magnitude); }

}  // namespace

Float approximate_asin(Float x, Accuracy accuracy) {
  if (accuracy == Accuracy::fast) {
    const Float magnitude = abs(x);
    const Float p = polynomial(magnitude, scaled(coefficients::acos_fast, -1.0f));
    const Float y = fma(root_of_fast(magnitude), p, half_pi_high);
    return select(x < 0.0f, -y, y);
  }
  const Inner in = inner_asin(x, accuracy);
  if (accuracy == Accuracy::standard) {
    const Float y = fma(in.value, -2.0f, half_pi_high);
    return select(in.far, select(x < 0.0f, -y, y), in.value);
  }
  const DoubleFloat sum = fast_two_sum(half_pi_high, in.w * Float(-2.0f));
  const Float y = sum.high + fma(in.rest, -2.0f, sum.low + Float(half_pi_low));
  return select(in.far, select(x < 0.0f, -y, y), in.value);
}

Float approximate_acos(Float x, Accuracy accuracy) {
  if (accuracy == Accuracy::fast) {
    const Float magnitude = abs(x);
    const Float y = root_of_fast(magnitude) * polynomial(magnitude, coefficients::acos_fast);
    return select(x < 0.0f, Float(pi_high) - y, y);
  }
  const Inner in = inner_asin(x, accuracy);
  if (accuracy == Accuracy::standard) {
    const Float twice = in.value + in.value;
    const Float far = select(x < 0.0f, Float(pi_high) - twice, twice);
    return select(in.far, far, Float(half_pi_high) - in.value);
  }
  // base - factor asin(w), where base is pi / 2, 0 or pi.
  const Bool negative = x < 0.0f;
  const Float base = select(in.far, select(negative, Float(pi_high), 0.0f), half_pi_high);
  const Float base_low = select(in.far, select(negative, Float(pi_low), 0.0f), half_pi_low);
  const Float factor = select(in.far, select(negative, Float(-2.0f), 2.0f), -1.0f);
  const DoubleFloat sum = fast_two_sum(base, factor * in.w);
  return sum.high + fma(factor, in.rest, sum.low + base_low);
}

}  // namespace nacre
