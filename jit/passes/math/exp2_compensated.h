#pragma once

#include "jit/passes/math/coefficients.h"
#include "jit/passes/math/constants.h"
#include "jit/passes/math/polynomial.h"
#include "runtime/value/value.h"

namespace nacre {

/// 2^(r + low), |r| <= 1 and low no more than an ulp or so of r: little over
/// half an ulp. The terms 1 + r ln 2 are summed without error, the rest is small.
inline Float exp2_compensated(Float r, Float low) {
  const Float high = fma(r, ln2_high, 1.0f);
  const Float high_low = fma(r, ln2_high, 1.0f - high);
  Float lost = r * Float(ln2_low);
  // high is near enough to 2^r as the slope.
  if (!low.is_constant(0.0f)) lost = fma(low * Float(ln2_high), high, lost);
  const Float tail = fma(r * r, polynomial(r, coefficients::exp2_precise), lost);
  return high + (high_low + tail);
}

}  // namespace nacre
