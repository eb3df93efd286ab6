#include "jit/passes/tangent.h"

#include <array>
#include <limits>
#include <numbers>
#include <utility>

namespace nacre {

namespace {

using Step = TangentStep;

bool vanishes(Float d) { return d.is_constant(0.0f); }

/// factor * d; nothing is recorded for a tangent that vanishes.
Float scale(Float factor, Float d) { return vanishes(d) ? d : factor * d; }

/// factor * d + rest.
Float scale_add(Float factor, Float d, Float rest) {
  if (vanishes(d)) return rest;
  return vanishes(rest) ? factor * d : fma(factor, d, rest);
}

Float plus(Float a, Float b) { return vanishes(a) ? b : vanishes(b) ? a : a + b; }
Float minus(Float a, Float b) { return vanishes(b) ? a : vanishes(a) ? -b : a - b; }

/// x where it is finite, else 0.
Float finite(Float x) {
  return select(abs(x) < Float(std::numeric_limits<float>::infinity()), x, 0.0f);
}

// -- Arithmetic ---------------------------------------------------------------

/// d(a + b) = da + db
Float d_add(const Step& s) { return plus(s.d[0], s.d[1]); }
/// d(a - b) = da - db
Float d_sub(const Step& s) { return minus(s.d[0], s.d[1]); }
/// d(a b) = a db + b da, which is the same for b a: which comes first depends on the order of
/// recording. So neither product is chosen to be fused here; contract() chooses.
Float d_mul(const Step& s) { return plus(scale(s.x[0], s.d[1]), scale(s.x[1], s.d[0])); }
/// d(a / b) = (da - (a / b) db) / b; 0 where b = 0
Float d_div(const Step& s) {
  const Float numerator = vanishes(s.d[1]) ? s.d[0] : scale_add(-s.y, s.d[1], s.d[0]);
  return select(s.x[1] != 0.0f, numerator / s.x[1], 0.0f);
}
/// d(a b + c) = a db + b da + dc
Float d_fma(const Step& s) { return scale_add(s.x[0], s.d[1], scale_add(s.x[1], s.d[0], s.d[2])); }
/// d min(a, b) = da where a < b, else db
Float d_min(const Step& s) { return select(s.x[0] < s.x[1], s.d[0], s.d[1]); }
/// d max(a, b) = da where a > b, else db
Float d_max(const Step& s) { return select(s.x[0] > s.x[1], s.d[0], s.d[1]); }
/// d sqrt(x) = dx / (2 sqrt(x)); 0 where x <= 0
Float d_sqrt(const Step& s) { return select(s.y > 0.0f, 0.5f / s.y, 0.0f) * s.d[0]; }
/// d(-x) = -dx
Float d_neg(const Step& s) { return -s.d[0]; }
/// d|x| = -dx where x < 0, else dx
Float d_abs(const Step& s) { return select(s.x[0] < 0.0f, -s.d[0], s.d[0]); }
/// d(c ? a : b) = c ? da : db
Float d_select(const Step& s) { return select(s.condition, s.d[1], s.d[2]); }

// -- Transcendental functions ---------------------------------------------------

/// d sin(x) = cos(x) dx
Float d_sin(const Step& s) { return cos(s.x[0]) * s.d[0]; }
/// d cos(x) = -sin(x) dx
Float d_cos(const Step& s) { return -sin(s.x[0]) * s.d[0]; }
/// d tan(x) = (1 + tan(x)^2) dx
Float d_tan(const Step& s) { return fma(s.y, s.y, 1.0f) * s.d[0]; }

/// 1 / sqrt(1 - x^2) from factors that do not cancel; 0 where |x| >= 1
Float arc_slope(Float x) {
  const Float squared = (1.0f - x) * (1.0f + x);
  return select(squared > 0.0f, 1.0f / sqrt(squared), 0.0f);
}
/// d asin(x) = dx / sqrt(1 - x^2); 0 where |x| >= 1
Float d_asin(const Step& s) { return arc_slope(s.x[0]) * s.d[0]; }
/// d acos(x) = -dx / sqrt(1 - x^2); 0 where |x| >= 1
Float d_acos(const Step& s) { return -arc_slope(s.x[0]) * s.d[0]; }

/// d atan2(y, x) = (x dy - y dx) / (x^2 + y^2); 0 where x = y = 0. With t the
/// quotient of the smaller by the larger, so that no square leaves the range:
/// (dy - t dx) / (x (1 + t^2)) for t = y / x, (t dy - dx) / (y (1 + t^2)) for t = x / y.
Float d_atan2(const Step& s) {
  const auto [y, x, unused] = s.x;
  const Bool flat = abs(x) > abs(y);
  const Float large = select(flat, x, y);
  const Float t = select(flat, y, x) / large;
  const Float numerator =
      minus(scale(select(flat, 1.0f, t), s.d[0]), scale(select(flat, t, 1.0f), s.d[1]));
  return select(large != 0.0f, numerator / (large * fma(t, t, 1.0f)), 0.0f);
}

/// d exp(x) = exp(x) dx
Float d_exp(const Step& s) { return s.y * s.d[0]; }
/// d exp2(x) = ln 2 exp2(x) dx
Float d_exp2(const Step& s) { return Float(std::numbers::ln2) * s.y * s.d[0]; }
/// d log(x) = dx / x; 0 where x <= 0
Float d_log(const Step& s) { return select(s.x[0] > 0.0f, s.d[0] / s.x[0], 0.0f); }
/// d log2(x) = dx / (x ln 2); 0 where x <= 0
Float d_log2(const Step& s) { return Float(std::numbers::log2e) * d_log(s); }

/// d x^y = y x^(y - 1) dx + x^y log(x) dy; the first factor is 0 where it is
/// not finite (x = 0, y < 1), the second where x <= 0.
Float d_pow(const Step& s) {
  const auto [x, y, unused] = s.x;
  const Float by_x = vanishes(s.d[0]) ? Float(0.0f) : finite(y * pow(x, y - 1.0f));
  const Float by_y = vanishes(s.d[1]) ? Float(0.0f) : select(x > 0.0f, finite(s.y * log(x)), 0.0f);
  return scale_add(by_x, s.d[0], scale(by_y, s.d[1]));
}

/// The bits of x with only the sign changed (copysign, xor of the sign bit, ...;
/// jit/passes/tangent_plan.h finds them): d y = dx where y = x, else -dx
Float d_from_bits(const Step& s) { return select(s.y == s.x[0], s.d[0], -s.d[0]); }

constexpr std::array<std::pair<Op, TangentRule>, 23> rules{{
    {Op::add, d_add},   {Op::sub, d_sub},     {Op::mul, d_mul},       {Op::div, d_div},
    {Op::fma, d_fma},   {Op::min, d_min},     {Op::max, d_max},       {Op::sqrt, d_sqrt},
    {Op::neg, d_neg},   {Op::abs, d_abs},     {Op::select, d_select}, {Op::from_bits, d_from_bits},
    {Op::sin, d_sin},   {Op::cos, d_cos},     {Op::tan, d_tan},       {Op::asin, d_asin},
    {Op::acos, d_acos}, {Op::atan2, d_atan2}, {Op::exp, d_exp},       {Op::exp2, d_exp2},
    {Op::log, d_log},   {Op::log2, d_log2},   {Op::pow, d_pow},
}};

}  // namespace

TangentRule tangent_rule(Op op) {
  for (const auto& [key, rule] : rules) {
    if (key == op) return rule;
  }
  return nullptr;
}

}  // namespace nacre
