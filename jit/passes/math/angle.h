#pragma once

#include "runtime/program/program.h"
#include "runtime/program/recorder.h"
#include "runtime/value/value.h"

namespace nacre {

/// x = turns * step + rest + low, where step is pi / 2 (or pi, where said).
struct Angle {
  Float rest;  ///< |rest| <= step / 2 and a little.
  Float low;   ///< What rest lacks; zero unless `precise`.
  Int turns;   ///< Modulo 2^22 or more; only the last bits matter.
};

template <class F>
void visit(Angle& angle, F&& f) {
  f(angle.rest), f(angle.low), f(angle.turns);
}

/// What is known of an angle: within largest_small_angle, and no NaN, or nothing.
enum class AngleSize { small, any };
inline constexpr float largest_small_angle = 0x1p+17f;

/// By quarter turns. precise: rest + low is right to 2^-40 of itself, standard: rest to an ulp, for
/// all finite x. fast: to 2^-24 of pi / 4 for |x| < 1e5, anything within [-0.8, 0.8] beyond. NaN
/// for infinities and NaN.
Angle reduce_angle(Recorder& recorder, Float x, Accuracy accuracy, AngleSize size);

/// By half turns, step pi, as `fast` above within [-1.6, 1.6].
Angle reduce_half_turns(Float x);

/// The parts of an angle of any size; `x` beyond 2^17. Outlined.
Angle reduce_large_angle(Recorder& recorder, Float x);

}  // namespace nacre
