#include "runtime/program/fold.h"

#include <bit>
#include <cmath>
#include <limits>

#include "runtime/float_environment.h"

namespace nacre {

namespace {

float as_float(std::uint32_t bits) { return std::bit_cast<float>(bits); }
std::int32_t as_int(std::uint32_t bits) { return std::bit_cast<std::int32_t>(bits); }

std::uint32_t from_float(float value) {
  if (std::isnan(value)) return canonical_nan;
  return flush_denormal(std::bit_cast<std::uint32_t>(value));
}
std::uint32_t from_int(std::int32_t value) { return std::bit_cast<std::uint32_t>(value); }

std::int32_t truncate_saturated(float value) {
  if (std::isnan(value)) return 0;
  if (value >= 2147483648.0f) return std::numeric_limits<std::int32_t>::max();
  if (value < -2147483648.0f) return std::numeric_limits<std::int32_t>::min();
  return static_cast<std::int32_t>(value);
}

// Rounds a double result of the C library once; glibc is within an ulp of
// double, so this is the correctly rounded float but for rare double roundings.
std::uint32_t rounded(double value) { return from_float(static_cast<float>(value)); }

std::optional<std::uint32_t> fold_float(Op op, float a, float b, float c) {
  switch (op) {
    case Op::add: return from_float(a + b);
    case Op::sub: return from_float(a - b);
    case Op::mul: return from_float(a * b);
    case Op::div: return from_float(a / b);
    case Op::fma: return from_float(std::fma(a, b, c));
    case Op::min: return from_float(a < b ? a : b);
    case Op::max: return from_float(a > b ? a : b);
    case Op::sqrt: return from_float(std::sqrt(a));
    case Op::neg: return from_float(-a);
    case Op::abs: return from_float(std::fabs(a));
    case Op::floor: return from_float(std::floor(a));
    case Op::ceil: return from_float(std::ceil(a));
    case Op::trunc: return from_float(std::trunc(a));
    case Op::round: return from_float(std::nearbyint(a));
    case Op::eq: return a == b;
    case Op::ne: return a != b;
    case Op::lt: return a < b;
    case Op::le: return a <= b;
    case Op::f_to_i: return from_int(truncate_saturated(a));
    case Op::bits: return from_float(a);
    default: return std::nullopt;
  }
}

std::optional<std::uint32_t> fold_transcendental(Op op, double a, double b) {
  switch (op) {
    case Op::sin: return rounded(std::sin(a));
    case Op::cos: return rounded(std::cos(a));
    case Op::tan: return rounded(std::tan(a));
    case Op::asin: return rounded(std::asin(a));
    case Op::acos: return rounded(std::acos(a));
    case Op::atan2: return rounded(std::atan2(a, b));
    case Op::exp: return rounded(std::exp(a));
    case Op::exp2: return rounded(std::exp2(a));
    case Op::log: return rounded(std::log(a));
    case Op::log2: return rounded(std::log2(a));
    case Op::pow: return rounded(std::pow(a, b));
    default: return std::nullopt;
  }
}

std::optional<std::uint32_t> fold_integer(Op op, std::uint32_t a, std::uint32_t b) {
  switch (op) {
    case Op::iadd: return a + b;
    case Op::isub: return a - b;
    case Op::imul: return a * b;
    case Op::umulhi: return static_cast<std::uint32_t>((static_cast<std::uint64_t>(a) * b) >> 32);
    case Op::iand:
    case Op::band: return a & b;
    case Op::ior:
    case Op::bor: return a | b;
    case Op::ixor:
    case Op::bxor: return a ^ b;
    case Op::bnot: return a ^ 1u;
    case Op::shl: return a << (b & 31u);
    case Op::lshr: return a >> (b & 31u);
    case Op::ashr: return from_int(as_int(a) >> (b & 31u));
    case Op::ieq: return a == b;
    case Op::ilt: return as_int(a) < as_int(b);
    case Op::ult: return a < b;
    case Op::i_to_f: return from_float(static_cast<float>(as_int(a)));
    case Op::u_to_f: return from_float(static_cast<float>(a));
    case Op::from_bits: return from_float(as_float(a));
    case Op::b_to_i: return a;
    case Op::half_to_f: return from_float(half_to_float(static_cast<std::uint16_t>(a)));
    default: return std::nullopt;
  }
}

}  // namespace

float half_to_float(std::uint16_t half) {
  const std::uint32_t sign = (half & 0x8000u) << 16;
  const std::uint32_t exponent = (half >> 10) & 0x1fu;
  const std::uint32_t mantissa = half & 0x3ffu;
  if (exponent == 0) {
    const float magnitude = std::ldexp(static_cast<float>(mantissa), -24);
    return sign != 0 ? -magnitude : magnitude;
  }
  if (exponent == 31) return as_float(sign | 0x7f800000u | (mantissa << 13));
  return as_float(sign | ((exponent + 112u) << 23) | (mantissa << 13));
}

std::optional<std::uint32_t> fold(Op op, std::span<const std::uint32_t> operands,
                                  std::uint32_t imm) {
  const ScopedFloatEnvironment environment;
  const auto at = [&](std::size_t i) { return i < operands.size() ? operands[i] : 0u; };
  if (op == Op::constant) return imm;
  if (op == Op::select) return at(0) != 0 ? at(1) : at(2);
  if (op == Op::keep || op == Op::stand_in) return at(0);
  if (op == Op::ddx) return 0u;
  if (is_transcendental(op)) {
    return fold_transcendental(op, as_float(at(0)), as_float(at(1)));
  }
  if (!info(op).operands.empty() && info(op).operands[0] == 'f') {
    return fold_float(op, as_float(at(0)), as_float(at(1)), as_float(at(2)));
  }
  return fold_integer(op, at(0), at(1));
}

}  // namespace nacre
