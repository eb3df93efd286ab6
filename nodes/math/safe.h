#pragma once

#include "runtime/value/value.h"

namespace nacre {

/// Total versions of operations that MaterialX leaves undefined somewhere;
/// the results are those of Open Shading Language, so every node that divides
/// or takes a root agrees with the others.
///
/// Sums and products have no such versions. They are IEEE's in all nodes: infinite above
/// the largest float, zero below the smallest normal one; infinity minus infinity and zero
/// times infinity are NaN, and NaN passes.

inline constexpr float float_max = 3.4028234664e38f;
/// Smallest normal float.
inline constexpr float float_min = 1.1754943508e-38f;

/// a / b; 0 where the quotient is not finite (x / 0, overflow, NaN).
inline Float safe_divide(Float a, Float b) {
  const Float quotient = a / b;
  return select(abs(quotient) <= float_max, quotient, 0.0f);
}

/// x^y; 1 for y = 0, else 0 for x = 0 and for a negative x with a fractional y.
/// Never infinite: limited to the largest float. NaN passes, but for y = 0.
inline Float safe_power(Float x, Float y) {
  if (y.is_constant(1.0f)) return x;
  if (y.is_constant(2.0f)) return x * x;
  const Float raised = min(float_max, max(-float_max, pow(x, y)));
  const Bool undefined = (x == 0.0f) | ((x < 0.0f) & (y != floor(y)));
  return select(y == 0.0f, 1.0f, select(undefined, 0.0f, raised));
}

/// ln x; that of the smallest normal float, -87.34, for anything less (zero and
/// below), and of the largest for infinity. NaN passes.
inline Float safe_log(Float x) { return log(min(float_max, max(float_min, x))); }

/// x limited to [-1, 1]; NaN passes.
inline Float unit_range(Float x) { return min(1.0f, max(-1.0f, x)); }

}  // namespace nacre
