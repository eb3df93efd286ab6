#include "runtime/reference/numbers.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

#include "runtime/program/fold.h"

namespace nacre {

double float_of(std::uint32_t bits) {
  return static_cast<double>(std::bit_cast<float>(flush_denormal(bits)));
}

std::uint32_t bits_of(double value) {
  const auto rounded = static_cast<float>(value);
  if (std::isnan(rounded)) return canonical_nan;
  return flush_denormal(std::bit_cast<std::uint32_t>(rounded));
}

std::int32_t truncate_saturated(double value) {
  if (std::isnan(value)) return 0;
  const double low = std::numeric_limits<std::int32_t>::min();
  const double high = std::numeric_limits<std::int32_t>::max();
  return static_cast<std::int32_t>(std::clamp(value, low, high));
}

double compute(Op op, double a, double b, double c) {
  switch (op) {
    case Op::add: return a + b;
    case Op::sub: return a - b;
    case Op::mul: return a * b;
    case Op::div: return a / b;
    case Op::fma: return std::fma(a, b, c);
    case Op::min: return a < b ? a : b;
    case Op::max: return a > b ? a : b;
    case Op::sqrt: return std::sqrt(a);
    case Op::neg: return -a;
    case Op::abs: return std::fabs(a);
    case Op::floor: return std::floor(a);
    case Op::ceil: return std::ceil(a);
    case Op::trunc: return std::trunc(a);
    case Op::round: return std::nearbyint(a);
    case Op::sin: return std::sin(a);
    case Op::cos: return std::cos(a);
    case Op::tan: return std::tan(a);
    case Op::asin: return std::asin(a);
    case Op::acos: return std::acos(a);
    case Op::atan2: return std::atan2(a, b);
    case Op::exp: return std::exp(a);
    case Op::exp2: return std::exp2(a);
    case Op::log: return std::log(a);
    case Op::log2: return std::log2(a);
    case Op::pow: return std::pow(a, b);
    default: assert(false && "not an operation on floats"); return 0.0;
  }
}

std::uint32_t compare(Op op, double a, double b) {
  switch (op) {
    case Op::eq: return a == b;
    case Op::ne: return a != b;
    case Op::lt: return a < b;
    default: return a <= b;
  }
}

}  // namespace nacre
