#pragma once

#include "jit/passes/math/angle.h"
#include "runtime/program/program.h"
#include "runtime/value/value.h"

namespace nacre {

// The transcendental functions in arithmetic of the Program: branch-free but
// for rare expensive paths. Special values, in every mode, are C99 Annex F's; a
// zero result may have the other sign where `fast` is meant; a result below the
// normal range may be zero. Bounds, held by bench/accuracy and the tests:
//
//   precise   1 ulp
//   standard  4 ulp
//   fast      as said below, for every finite argument
//
// Each mode costs less than the one before it; in operations, and ulps measured
// (relative or absolute errors for fast), see the table that accuracy_math prints.

/// fast: relative 2^-13; exp(0) = 1; never decreasing but for rounding.
Float approximate_exp(Float x, Accuracy accuracy);
Float approximate_exp2(Float x, Accuracy accuracy);

/// fast: relative 2^-13; log(1) = 0.
Float approximate_log(Float x, Accuracy accuracy);
Float approximate_log2(Float x, Accuracy accuracy);

/// fast: relative 2^-15 while the result is normal; pow(x, 0) = 1. Outlined in
/// the other modes.
Float approximate_pow(Recorder& recorder, Float x, Float y, Accuracy accuracy);

/// `angle` is reduce_angle()'s of x; in fast, reduce_half_turns()'s.
/// fast: absolute 2^-13 for |x| < 1e5, sin(0) = 0, cos(0) = 1; beyond, the angle
/// is off by |x| 2^-24 and more, and only |sin|, |cos| <= 1.001 holds.
Float approximate_sin(Float x, Angle angle, Accuracy accuracy);
Float approximate_cos(Angle angle, Accuracy accuracy);

/// `angle` is reduce_angle()'s of x. fast: relative 2^-13 for an angle off by
/// at most 2^-33, for |x| < 1e5; beyond, any value of tan, no NaN.
Float approximate_tan(Float x, Angle angle, Accuracy accuracy);

/// fast: absolute 2^-14; asin(0) = 0, acos(1) = 0.
Float approximate_asin(Float x, Accuracy accuracy);
Float approximate_acos(Float x, Accuracy accuracy);

/// fast: relative 2^-14.
Float approximate_atan2(Float y, Float x, Accuracy accuracy);

}  // namespace nacre
