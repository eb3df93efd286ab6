#include "jit/passes/math/coefficients.h"
#include "jit/passes/math/constants.h"
#include "jit/passes/math/double_float.h"
#include "jit/passes/math/functions.h"
#include "jit/passes/math/polynomial.h"

namespace nacre {

namespace {

constexpr float tan_eighth_pi = 0x1.a8279ap-2f;
constexpr float least_normal = 0x1p-126f;

Bool sign_bit(Float x) { return bits_of(x) < Int(0); }

/// The smaller over the larger of |y| and |x|; NaN where either is.
struct Octant {
  Bool steep;     ///< |y| > |x|.
  Bool backward;  ///< x has the sign bit.
  Float smaller;
  Float larger;
};

Octant octant_of(Float y, Float x) {
  const Float a = abs(y);
  const Float b = abs(x);
  const Bool steep = b < a;
  return {steep, sign_bit(x), select(steep, b, a), select(steep, a, b)};
}

/// num / den + low, with an angle of `eighths` * pi / 4 taken away.
struct Ratio {
  Float high;
  Float low;
  Bool eighth;
};

/// smaller / larger to twice the precision, brought below tan(pi / 8) by
/// atan(t) = pi / 4 + atan((t - 1) / (t + 1)).
Ratio precise_ratio(Octant o) {
  // Two infinities count as equal, one dwarfs the other operand; NaN stays.
  const Bool infinite = o.larger == Float(infinity);
  const Float beside_infinity = select(o.smaller == o.larger, 1.0f, o.smaller * Float(0.0f));
  const Float a = select(infinite, 1.0f, o.larger);
  const Float b = select(infinite, beside_infinity, o.smaller);
  // Away from the ends of the range, where residuals would vanish.
  const Float scale = select(a > Float(0x1p+64f), Float(0x1p-64f),
                             select(a < Float(0x1p-32f), Float(0x1p+64f), 1.0f));
  const Float larger = max(Float(least_normal), a * scale);
  const Float smaller = b * scale;
  const Bool eighth = smaller > larger * Float(tan_eighth_pi);
  const Float difference = smaller - larger;
  const Float sum = larger + smaller;
  const Float num = select(eighth, difference, smaller);
  const Float num_low = select(eighth, smaller - (difference + larger), 0.0f);
  const Float den = select(eighth, sum, larger);
  const Float den_low = select(eighth, smaller - (sum - larger), 0.0f);
  const Float q = num / den;
  const Float residual = fma(-q, den_low, fma(-q, den, num) + num_low);
  return {q, residual / den, eighth};
}

Float atan2_precise(Float y, Float x) {
  const Octant o = octant_of(y, x);
  const Ratio t = precise_ratio(o);
  const Float square = t.high * t.high;
  // atan(t + low) = atan(t) + low / (1 + t^2).
  const Float from_low = t.low * (1.0f - square);
  const Float rest = fma(t.high * square, polynomial(square, coefficients::atan_precise), from_low);
  // The angle is base * pi / 4 plus or minus atan(t).
  const Float in_octant = select(t.eighth, Float(1.0f), Float(0.0f));
  const Float in_quarter = select(o.steep, 2.0f - in_octant, in_octant);
  const Float base = select(o.backward, 4.0f - in_quarter, in_quarter);
  const DoubleFloat angle = two_product(base, quarter_pi_high);
  const Bool minus = o.steep ^ o.backward;
  const Float high = select(minus, -t.high, t.high);
  const Float low = select(minus, -rest, rest);
  const DoubleFloat sum = fast_two_sum(angle.high, high);
  const Float magnitude = sum.high + (low + fma(base, quarter_pi_low, angle.low + sum.low));
  return select(sign_bit(y), -magnitude, magnitude);
}

}  // namespace

Float approximate_atan2(Float y, Float x, Accuracy accuracy) {
  if (accuracy == Accuracy::precise) return atan2_precise(y, x);
  const Octant o = octant_of(y, x);
  const Float larger = max(Float(least_normal), o.larger);  // 0 / 0 counts as 0.
  // Equal operands give 1 even where they are infinite.
  const Float t = select(o.smaller == larger, 1.0f, o.smaller / larger);
  const Float square = t * t;
  const Float p = accuracy == Accuracy::standard ? polynomial(square, coefficients::atan_standard)
                                                 : polynomial(square, coefficients::atan_fast);
  const Float angle = fma(t * square, p, t);
  const Float in_quarter = select(o.steep, Float(half_pi_high) - angle, angle);
  const Float magnitude = select(o.backward, Float(pi_high) - in_quarter, in_quarter);
  return select(sign_bit(y), -magnitude, magnitude);
}

}  // namespace nacre
