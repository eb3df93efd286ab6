#include "jit/passes/math/coefficients.h"
#include "jit/passes/math/constants.h"
#include "jit/passes/math/double_float.h"
#include "jit/passes/math/exp2_compensated.h"
#include "jit/passes/math/functions.h"
#include "jit/passes/math/polynomial.h"
#include "jit/passes/math/power_of_two.h"

namespace nacre {

namespace {

/// 2^x in x = n + f, f in [0, 1): exact at integers and continuous.
Float exp2_fast(Float x) {
  const Float inside = min(Float(128.0f), max(Float(-127.0f), x));
  const Float n = floor(inside);
  const Float f = inside - n;
  return fma(f, polynomial(f, coefficients::exp2_fast), 1.0f) * power_of_two(n + exponent_shift);
}

}  // namespace

Float approximate_exp(Float x, Accuracy accuracy) {
  if (accuracy == Accuracy::fast) return exp2_fast(x * Float(log2e_high));
  Float inside = max(Float(-87.5f), x);  // Below, every result is zero.
  // The error-free sum of `precise` has no place for infinity.
  if (accuracy == Accuracy::precise) inside = min(Float(89.0f), inside);
  const Exponent n = nearest_exponent(fma(inside, log2e_high, exponent_shift));
  const Float first = fma(n.value, -ln2_high, inside);  // Exact but for overflow.
  const Float r = fma(n.value, -ln2_low, first);
  if (accuracy == Accuracy::standard) {
    return fma(r, polynomial(r, coefficients::exp_standard), 1.0f) * power_of_two(n.shifted);
  }
  const Float low = fma(n.value, -ln2_low, first - r);
  const DoubleFloat linear = fast_two_sum(1.0f, r);
  const Float tail = fma(r * r, polynomial(r, coefficients::exp_precise), low);
  return (linear.high + (linear.low + tail)) * power_of_two(n.shifted);
}

Float approximate_exp2(Float x, Accuracy accuracy) {
  if (accuracy == Accuracy::fast) return exp2_fast(x);
  Float inside = max(Float(-127.0f), x);
  if (accuracy == Accuracy::precise) inside = min(Float(128.0f), inside);
  const Exponent n = nearest_exponent(inside + exponent_shift);
  const Float r = inside - n.value;
  const Float scale = power_of_two(n.shifted);
  if (accuracy == Accuracy::precise) return exp2_compensated(r, 0.0f) * scale;
  return fma(r, polynomial(r, coefficients::exp2_standard), 1.0f) * scale;
}

}  // namespace nacre
