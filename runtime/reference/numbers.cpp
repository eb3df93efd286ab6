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

void compute(Op op, Points64 points, const Value64* x, const Value64* y, const Value64* z,
             Value64* to) {
  const auto each = [&](auto&& f) {
    for (const std::uint32_t i : points) to[i].f = f(x[i].f, y[i].f, z[i].f);
  };
  switch (op) {
    case Op::add: return each([](double a, double b, double) { return a + b; });
    case Op::sub: return each([](double a, double b, double) { return a - b; });
    case Op::mul: return each([](double a, double b, double) { return a * b; });
    case Op::div: return each([](double a, double b, double) { return a / b; });
    case Op::fma: return each([](double a, double b, double c) { return std::fma(a, b, c); });
    case Op::min: return each([](double a, double b, double) { return a < b ? a : b; });
    case Op::max: return each([](double a, double b, double) { return a > b ? a : b; });
    case Op::sqrt: return each([](double a, double, double) { return std::sqrt(a); });
    case Op::neg: return each([](double a, double, double) { return -a; });
    case Op::abs: return each([](double a, double, double) { return std::fabs(a); });
    case Op::floor: return each([](double a, double, double) { return std::floor(a); });
    case Op::ceil: return each([](double a, double, double) { return std::ceil(a); });
    case Op::trunc: return each([](double a, double, double) { return std::trunc(a); });
    case Op::round: return each([](double a, double, double) { return std::nearbyint(a); });
    case Op::sin: return each([](double a, double, double) { return std::sin(a); });
    case Op::cos: return each([](double a, double, double) { return std::cos(a); });
    case Op::tan: return each([](double a, double, double) { return std::tan(a); });
    case Op::asin: return each([](double a, double, double) { return std::asin(a); });
    case Op::acos: return each([](double a, double, double) { return std::acos(a); });
    case Op::atan2: return each([](double a, double b, double) { return std::atan2(a, b); });
    case Op::exp: return each([](double a, double, double) { return std::exp(a); });
    case Op::exp2: return each([](double a, double, double) { return std::exp2(a); });
    case Op::log: return each([](double a, double, double) { return std::log(a); });
    case Op::log2: return each([](double a, double, double) { return std::log2(a); });
    case Op::pow: return each([](double a, double b, double) { return std::pow(a, b); });
    default: assert(false && "not an operation on floats");
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
