#include <array>
#include <cstdint>

#include "jit/passes/math/angle.h"
#include "jit/passes/math/constants.h"
#include "jit/passes/math/double_float.h"
#include "runtime/value/control.h"

namespace nacre {

namespace {

/// 2 / pi without the leading "0.", in binary: 224 bits.
constexpr std::array<std::uint32_t, 7> two_over_pi_bits{
    0xa2f9836e, 0x4e441529, 0xfc2757d1, 0xf534ddc0, 0xdb629599, 0x3c439041, 0xfe5163ab};

constexpr int first_exponent = 17;
constexpr int last_exponent = 127;
using Part = std::array<float, last_exponent - first_exponent + 1>;

/// Bit i of 2 / pi, of weight 2^-i; 0 above the point.
constexpr std::uint32_t bit(int i) {
  if (i < 1) return 0;
  const auto k = static_cast<std::uint32_t>(i - 1);
  return (two_over_pi_bits[k / 32] >> (31 - k % 32)) & 1u;
}

/// Part `number` of 2^(e - 23) * 2 / pi modulo 4, for each exponent e of x: 24
/// bits, the first part from weight 2 on. With the integer mantissa M of x,
/// M times the sum of the parts is x * 2 / pi modulo 4. (M. Payne, R. Hanek,
/// Radian reduction for trigonometric functions, SIGNUM Newsletter 18, 1983.)
constexpr Part make_part(int number) {
  Part part{};
  for (int e = first_exponent; e <= last_exponent; ++e) {
    float value = 0.0f;
    float weight = 2.0f;
    for (int k = 0; k < 24 * number; ++k) weight *= 0.5f;
    for (int k = 0; k < 24; ++k, weight *= 0.5f) {
      if (bit(e - 24 + 24 * number + k) != 0) value += weight;
    }
    part[static_cast<std::size_t>(e - first_exponent)] = value;
  }
  return part;
}

constexpr std::array<Part, 4> parts{make_part(0), make_part(1), make_part(2), make_part(3)};
constexpr std::array<const char*, 4> part_names{"two_over_pi_0", "two_over_pi_1", "two_over_pi_2",
                                                "two_over_pi_3"};

Float part_of(Recorder& recorder, std::size_t number, Int index) {
  const std::uint32_t table = recorder.table(part_names[number], parts[number]);
  return Float(record(Op::table, {index.ref()}, table));
}

/// x * 2 / pi = turns + fraction, |fraction| <= 1/2; turns modulo 4.
struct QuarterTurns {
  Float turns_1, turns_2;  ///< Integers; turns_1 up to 2^26.
  DoubleFloat fraction;
};

QuarterTurns quarter_turns(Recorder& recorder, Float x) {
  const Int bits = bits_of(x);
  const Int index = (shift_right_logical(bits, 23) & Int(255)) - Int(127 + first_exponent);
  const Float mantissa =
      float_of_bits((bits & Int(static_cast<std::int32_t>(0x807fffffu))) | Int(0x4b000000));
  const DoubleFloat product_0 = two_product(mantissa, part_of(recorder, 0, index));
  const DoubleFloat product_1 = two_product(mantissa, part_of(recorder, 1, index));
  const DoubleFloat product_2 = two_product(mantissa, part_of(recorder, 2, index));
  const Float product_3 = mantissa * part_of(recorder, 3, index);
  // Product 0 is a multiple of 2^-22: its fraction is exact in one float.
  const Float whole_0 = round(product_0.high);
  const Float whole_1 = round(product_0.low);
  const Float whole_2 = round(product_1.high);
  const Float fraction_0 = (product_0.high - whole_0) + (product_0.low - whole_1);
  const Float fraction_1 = product_1.high - whole_2;
  const Float whole_3 = round(fraction_0 + fraction_1);
  // The rest may cancel to 2^-30, so every error on the way is kept.
  const DoubleFloat a = two_sum(fraction_0 - whole_3, fraction_1);
  const DoubleFloat b = two_sum(a.high, product_1.low);
  const DoubleFloat c = two_sum(b.high, product_2.high);
  const Float low = (a.low + b.low) + (c.low + (product_2.low + product_3));
  return {whole_0, (whole_1 + whole_2) + whole_3, fast_two_sum(c.high, low)};
}

}  // namespace

Angle reduce_large_angle(Recorder& recorder, Float x) {
  const auto body = [&recorder](Float angle) {
    const QuarterTurns q = quarter_turns(recorder, angle);
    const Float high = q.fraction.high * Float(half_pi_high);
    const Float error = fma(q.fraction.high, half_pi_high, -high);
    const Float low = fma(q.fraction.low, half_pi_high, fma(q.fraction.high, half_pi_low, error));
    const DoubleFloat rest = fast_two_sum(high, low);
    // Infinities and NaN come out as NaN, which 0 x is for them.
    return Angle{fma(angle, 0.0f, rest.high), rest.low, to_int(q.turns_1) + to_int(q.turns_2)};
  };
  return outline<Angle>(recorder, "reduce_large_angle", body, x);
}

}  // namespace nacre
