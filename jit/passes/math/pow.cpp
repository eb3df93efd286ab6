#include "jit/passes/math/coefficients.h"
#include "jit/passes/math/constants.h"
#include "jit/passes/math/double_float.h"
#include "jit/passes/math/exp2_compensated.h"
#include "jit/passes/math/functions.h"
#include "jit/passes/math/mantissa.h"
#include "jit/passes/math/polynomial.h"
#include "jit/passes/math/power_of_two.h"
#include "runtime/value/control.h"

namespace nacre {

namespace {

// y log2(x) reaches 128, so a relative error e of the logarithm is one of 89 e
// in the result. With s = f / (2 + f), log2(1 + f) = 2 L (s + s^3 / 3 + ...),
// L = log2(e), where |s| <= 0.172 keeps all but the first term small. The code
// works on -s, which needs no negations.
constexpr float minus_two_l = -2.0f * log2e_high;
constexpr float minus_two_l_low = -2.0f * log2e_low;
constexpr auto cubic = coefficients::atanh_of_pow;

/// f / (2 + f), negated, to twice the precision.
DoubleFloat minus_s(Float f) {
  const Float m = 1.0f + f;  // Exact: f came from m - 1.
  const Float den = m + 1.0f;
  const Float den_low = m - (den - 1.0f);
  const Float minus_reciprocal = -1.0f / den;
  const Float s = f * minus_reciprocal;
  const Float residual = fma(s, den_low, fma(s, den, f));
  return {s, residual * minus_reciprocal};
}

/// -2 L (s + s^3 p): relative error 2^-28.
DoubleFloat log2_of_s(DoubleFloat s) {
  const Float square = s.high * s.high;
  const DoubleFloat linear = two_product(s.high, minus_two_l);
  const Float p = polynomial(square, scaled(cubic, minus_two_l));
  const Float slope = fma(square, s.low, s.low);  // s^3 / 3 changes by s^2 s.low.
  const Float low = fma(slope, minus_two_l, fma(s.high, minus_two_l_low, linear.low));
  return {linear.high, fma(s.high * square, p, low)};
}

/// The same with s^2 and the coefficient 1/3 to twice the precision: 2^-33.
DoubleFloat log2_of_s_precise(DoubleFloat s) {
  const DoubleFloat square = two_product(s.high, s.high);
  const Float square_low = fma(s.high * Float(2.0f), s.low, square.low);
  const Float higher = fma(fma(cubic[3], square.high, cubic[2]), square.high, cubic[1]);
  const Float p = fma(square.high, higher, cubic[0]);
  const Float p_low = fma(square.high, higher, Float(cubic[0]) - p);
  const DoubleFloat w = two_product(square.high, p);
  const Float w_low = fma(square.high, p_low, fma(square_low, p, w.low));
  const DoubleFloat third = two_product(s.high, w.high);
  const Float third_low = fma(s.high, w_low, fma(s.low, w.high, third.low));
  const DoubleFloat sum = fast_two_sum(s.high, third.high);
  const Float sum_low = (sum.low + third_low) + s.low;
  const DoubleFloat result = two_product(sum.high, minus_two_l);
  return {result.high, fma(sum_low, minus_two_l, fma(sum.high, minus_two_l_low, result.low))};
}

DoubleFloat extended_log2(Float x, Accuracy accuracy) {
  // Here the sum with the exponent cancels least.
  const Mantissa m = split_mantissa(x, sqrt_half_bits);
  const DoubleFloat s = minus_s(m.f);
  const DoubleFloat part = accuracy == Accuracy::precise ? log2_of_s_precise(s) : log2_of_s(s);
  const DoubleFloat sum = fast_two_sum(m.scaled_exponent * Float(0x1p-23f), part.high);
  return fast_two_sum(sum.high, sum.low + part.low);
}

/// log2(0) and log2 of infinity and NaN put in place of what the formula gave.
Float with_ends(Float magnitude, Float logarithm) {
  const Float above_zero = select(magnitude < Float(infinity), logarithm, magnitude);
  return select(magnitude == 0.0f, Float(-infinity), above_zero);
}

/// magnitude^y; nothing in particular where y is 0 or magnitude 1 and the other not finite.
Float positive_pow(Float magnitude, Float y, Accuracy accuracy) {
  DoubleFloat logarithm = extended_log2(magnitude, accuracy);
  logarithm.high = with_ends(magnitude, logarithm.high);
  // No |log2| but 0 is below 2^-24: this y over- or underflows as any larger.
  const Float exponent = min(Float(0x1p+40f), max(Float(-0x1p+40f), y));
  const Float product = exponent * logarithm.high;
  const Float inside = min(Float(128.0f), max(Float(-127.0f), product));
  const Float beyond = fma(exponent, logarithm.low, fma(exponent, logarithm.high, -inside));
  // Small, unless the result over- or underflows: then it is far enough beyond.
  const Float low = min(Float(4.0f), max(Float(-1.0f), beyond));
  const Exponent n = nearest_exponent(inside + exponent_shift);
  const DoubleFloat r = fast_two_sum(inside - n.value, low);
  const Float scale = power_of_two(n.shifted);
  if (accuracy == Accuracy::precise) return exp2_compensated(r.high, r.low) * scale;
  return fma(r.high, polynomial(r.high, coefficients::exp2_standard), 1.0f) * scale;
}

Float positive_pow_fast(Float magnitude, Float y) {
  const Float x = y * with_ends(magnitude, log2_standard(split_mantissa(magnitude)));
  const Float inside = min(Float(128.0f), max(Float(-127.0f), x));
  const Float n = floor(inside);
  const Float p = polynomial(inside - n, coefficients::exp2_of_pow_fast);
  return fma(inside - n, p, 1.0f) * power_of_two(n + exponent_shift);
}

/// The result for a base with the sign bit, from that of its magnitude.
Float negative_pow(Float x, Float y, Float of_magnitude) {
  const Bool whole = floor(y) == y;
  const Float half = y * Float(0.5f);
  const Bool odd = whole & (floor(half) != half);
  const Bool undefined = (!whole) & (x < 0.0f) & (x > Float(-infinity));
  const Float y_signed = select(odd, -of_magnitude, of_magnitude);
  return select(undefined, Float(not_a_number), y_signed);
}

Float inline_pow(Float x, Float y, Accuracy accuracy) {
  const Float magnitude = abs(x);
  const Float general = accuracy == Accuracy::fast ? positive_pow_fast(magnitude, y)
                                                   : positive_pow(magnitude, y, accuracy);
  // Also where the other operand is infinite or NaN.
  const Bool one = (y == 0.0f) | (magnitude == 1.0f);
  const Float of_magnitude = select(one, 1.0f, general);
  return if_any(bits_of(x) < Int(0), of_magnitude,
                [&] { return negative_pow(x, y, of_magnitude); });
}

}  // namespace

Float approximate_pow(Recorder& recorder, Float x, Float y, Accuracy accuracy) {
  const auto body = [accuracy](Float base, Float exponent) {
    return inline_pow(base, exponent, accuracy);
  };
  if (accuracy == Accuracy::fast) return body(x, y);
  return outline<Float>(recorder, "pow", body, x, y);
}

}  // namespace nacre
