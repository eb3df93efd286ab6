#pragma once

#include "jit/passes/math/angle.h"
#include "runtime/program/program.h"
#include "runtime/value/value.h"

namespace nacre {

// The transcendental functions in arithmetic of the Program: branch-free but
// for rare expensive paths. Special values, in every mode, are C99 Annex F's
// (zero arguments of odd functions may lose their sign in `fast`); a result
// below the normal range may be zero. Measured by bench/accuracy:
//
//   precise   at most 1 ulp
//   standard  at most 4 ulp
//   fast      as said below, for every finite argument

/// fast: relative 2^-13; exp(0) = 1. A result above the range is infinite.
Float approximate_exp(Float x, Accuracy accuracy);
Float approximate_exp2(Float x, Accuracy accuracy);

/// fast: relative 2^-14; log(1) = 0.
Float approximate_log(Float x, Accuracy accuracy);
Float approximate_log2(Float x, Accuracy accuracy);

/// fast: relative 2^-15 while the result is normal; pow(x, 0) = 1.
Float approximate_pow(Recorder& recorder, Float x, Float y, Accuracy accuracy);

/// fast: absolute 2^-13, within [-1, 1], for |x| < 1e5; beyond, the error grows
/// with |x| 2^-24, still within [-1, 1]. precise and standard take the angle
/// from reduce_angle(), fast from reduce_half_turns().
Float approximate_sin(Float x, Angle angle, Accuracy accuracy);
Float approximate_cos(Angle angle, Accuracy accuracy);
/// fast: relative 2^-13 of tan of an angle that is off by 2^-23 times the larger of |x| 2^-16 and
/// 1, for |x| < 1e5; beyond, as the others.
Float approximate_tan(Float x, Angle angle, Accuracy accuracy);

/// fast: absolute 2^-14; asin(0) = 0, acos(1) = 0.
Float approximate_asin(Float x, Accuracy accuracy);
Float approximate_acos(Float x, Accuracy accuracy);

/// fast: relative 2^-14.
Float approximate_atan2(Float y, Float x, Accuracy accuracy);

}  // namespace nacre
