#include "jit/passes/math/angle.h"

#include "jit/passes/math/constants.h"
#include "jit/passes/math/double_float.h"
#include "runtime/value/control.h"

namespace nacre {

namespace {

// pi / 2 in three parts, the first two truncated to 24 bits, so that all are
// positive: -(0 * part) keeps the sign of a zero that it is added to.
constexpr float half_pi_1 = 0x1.921fb4p+0f;
constexpr float half_pi_2 = 0x1.4442dp-24f;
constexpr float half_pi_3 = 0x1.84698ap-48f;
constexpr float two_over_pi = 0x1.45f306p-1f;

// The three parts are exact enough up to the largest small angle: turns has 17 bits, so that
// turns * half_pi_1 and the difference to x are exact with fma; the parts after the third are
// 2^-72, and no float of this range comes nearer than 2^-28 to a multiple of pi / 2 (W. J. Cody,
// W. Waite, Software Manual for the Elementary Functions, 1980, ch. 8, for the scheme).

/// |x| in float integer steps: x * per_step rounded, as a float and in low bits.
struct Turns {
  Float count;
  Int low_bits;
};

Turns nearest_turns(Float x, float per_step) {
  const Float shifted = fma(x, per_step, round_to_low_bits);
  return {shifted - round_to_low_bits, bits_of(shifted)};
}

Angle reduce_small_precise(Float x, Turns turns) {
  const Float first = fma(turns.count, -half_pi_1, x);
  const Float second = turns.count * Float(half_pi_2);
  const Float second_error = fma(turns.count, half_pi_2, -second);
  // `first` is a multiple of an ulp of `second`: the difference is error-free.
  const Float rest = first - second;
  const Float lost = (first - rest) - second;
  const Float low = fma(turns.count, -half_pi_3, lost - second_error);
  // Where rest is tiny, low is more than an ulp of it.
  const DoubleFloat sum = fast_two_sum(rest, low);
  return {sum.high, sum.low, turns.low_bits};
}

Angle reduce_small(Float x, Turns turns) {
  const Float first = fma(turns.count, -half_pi_1, x);
  const Float second = fma(turns.count, -half_pi_2, first);
  return {fma(turns.count, -half_pi_3, second), 0.0f, turns.low_bits};
}

/// Two parts are enough, and a bound instead of the path for large angles. Not
/// by nearest_turns(): where reassociation is allowed, (x + c) - c is x.
Angle reduce_fast(Float x, float per_step, float part_1, float part_2, float bound) {
  const Float count = round(x * Float(per_step));
  const Float rest = fma(count, -part_2, fma(count, -part_1, x));
  // In this order NaN passes.
  const Float inside = min(Float(bound), max(Float(-bound), rest));
  return {inside, 0.0f, bits_of(count + Float(round_to_low_bits))};
}

}  // namespace

Angle reduce_half_turns(Float x) {
  return reduce_fast(x, 0.5f * two_over_pi, 2 * half_pi_1, 2 * half_pi_2, 1.6f);
}

Angle reduce_angle(Recorder& recorder, Float x, Accuracy accuracy, AngleSize size) {
  if (accuracy == Accuracy::fast) {
    return reduce_fast(x, two_over_pi, half_pi_1, half_pi_2, 0.8f);
  }
  const Turns turns = nearest_turns(x, two_over_pi);
  const bool precise = accuracy == Accuracy::precise;
  const Angle small = precise ? reduce_small_precise(x, turns) : reduce_small(x, turns);
  if (size == AngleSize::small) return small;
  return if_any(abs(x) > Float(largest_small_angle), small, [&] {
    Angle large = reduce_large_angle(recorder, x);
    if (!precise) large.low = 0.0f;
    return large;
  });
}

}  // namespace nacre
