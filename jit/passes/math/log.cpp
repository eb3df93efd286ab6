#include "jit/passes/math/coefficients.h"
#include "jit/passes/math/constants.h"
#include "jit/passes/math/double_float.h"
#include "jit/passes/math/functions.h"
#include "jit/passes/math/mantissa.h"
#include "jit/passes/math/polynomial.h"

namespace nacre {

namespace {

/// y, the logarithm where x is positive and finite, with the special values.
Float with_special_values(Float x, Float y) {
  const Float at_most_zero = select(x == 0.0f, Float(-infinity), Float(not_a_number));
  return select(x <= 0.0f, at_most_zero, select(x < Float(infinity), y, x));
}

// ln 2 in 15 bits, so that its product with an exponent is exact, and the rest.
constexpr float ln2_short = 0x1.62e4p-1f;
constexpr float ln2_rest = 0x1.7f7d1cp-20f;

Float log_precise(Mantissa m) {
  const DoubleFloat sum = fast_two_sum(m.scaled_exponent * Float(ln2_short * 0x1p-23f), m.f);
  const Float p = fma(m.f, polynomial(m.f, coefficients::log_precise), -0.5f);
  const Float low = fma(m.scaled_exponent, ln2_rest * 0x1p-23f, sum.low);
  return sum.high + fma(m.f * m.f, p, low);
}

Float log_standard(Mantissa m) {
  const Float p = fma(m.f, polynomial(m.f, coefficients::log_standard), -0.5f);
  return fma(m.scaled_exponent, ln2_high * 0x1p-23f, fma(m.f * m.f, p, m.f));
}

Float log2_precise(Mantissa m) {
  const DoubleFloat linear = two_product(m.f, log2e_high);
  const Float p = fma(m.f, polynomial(m.f, coefficients::log2_precise), -0.5f * log2e_high);
  const DoubleFloat sum = fast_two_sum(m.scaled_exponent * Float(0x1p-23f), linear.high);
  const Float low = fma(m.f, log2e_low, linear.low) + sum.low;
  return sum.high + fma(m.f * m.f, p, low);
}

}  // namespace

Float log2_standard(Mantissa m) {
  const Float p = fma(m.f, polynomial(m.f, coefficients::log2_standard), -0.5f * log2e_high);
  return fma(m.scaled_exponent, 0x1p-23f, fma(m.f * m.f, p, m.f * Float(log2e_high)));
}

Float approximate_log(Float x, Accuracy accuracy) {
  const Mantissa m = split_mantissa(x);
  switch (accuracy) {
    case Accuracy::precise: return with_special_values(x, log_precise(m));
    case Accuracy::standard: return with_special_values(x, log_standard(m));
    case Accuracy::fast: break;
  }
  const Float y = m.f * polynomial(m.f, coefficients::log_fast);
  return with_special_values(x, fma(m.scaled_exponent, ln2_high * 0x1p-23f, y));
}

Float approximate_log2(Float x, Accuracy accuracy) {
  const Mantissa m = split_mantissa(x);
  switch (accuracy) {
    case Accuracy::precise: return with_special_values(x, log2_precise(m));
    case Accuracy::standard: return with_special_values(x, log2_standard(m));
    case Accuracy::fast: break;
  }
  const Float y = m.f * polynomial(m.f, coefficients::log2_fast);
  return with_special_values(x, fma(m.scaled_exponent, 0x1p-23f, y));
}

}  // namespace nacre
