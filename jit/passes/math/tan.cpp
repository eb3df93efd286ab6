#include "jit/passes/math/coefficients.h"
#include "jit/passes/math/double_float.h"
#include "jit/passes/math/functions.h"
#include "jit/passes/math/polynomial.h"

namespace nacre {

namespace {

/// rest + rest^3 p(rest^2) with the leading terms' errors kept.
DoubleFloat tan_near_zero(Angle a) {
  const DoubleFloat square = two_product(a.rest, a.rest);
  constexpr auto& c = coefficients::tan_precise;
  Float higher = c.back();
  for (std::size_t i = c.size() - 1; i-- > 1;) higher = fma(higher, square.high, c[i]);
  const Float p = fma(square.high, higher, c[0]);
  const Float p_low = fma(square.high, higher, Float(c[0]) - p);
  const DoubleFloat w = two_product(square.high, p);
  const Float w_low = fma(square.high, p_low, fma(square.low, p, w.low));
  const DoubleFloat cubic = two_product(a.rest, w.high);
  const DoubleFloat sum = fast_two_sum(a.rest, cubic.high);
  // tan(r + low) = tan(r) + low (1 + tan(r)^2).
  const Float from_low = fma(a.low * sum.high, sum.high, a.low);
  return {sum.high, sum.low + (fma(a.rest, w_low, cubic.low) + from_low)};
}

}  // namespace

Float approximate_tan(Float x, Angle a, Accuracy accuracy) {
  const Bool even = (a.turns & Int(1)) == Int(0);
  if (accuracy == Accuracy::precise) {
    const DoubleFloat t = tan_near_zero(a);
    const Float q = -1.0f / t.high;
    const Float residual = fma(q, t.low, fma(q, t.high, 1.0f));
    const Float y = select(even, t.high + t.low, fma(q, residual, q));
    return select(x == 0.0f, x, y);  // The sums lose the sign of zero.
  }
  const Float square = a.rest * a.rest;
  const Float p = accuracy == Accuracy::standard ? polynomial(square, coefficients::tan_standard)
                                                 : polynomial(square, coefficients::tan_fast);
  const Float t = fma(a.rest * square, p, a.rest);
  return select(even, t, -1.0f / t);
}

}  // namespace nacre
