#include "tests/support/interval.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nacre::testing {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double float_max = std::numeric_limits<float>::max();
constexpr double float_min = std::numeric_limits<float>::min();
constexpr double half_ulp = 0x1.000001p-24;  ///< Relative, and the rounding to double.
constexpr Enclosure none{infinity, -infinity, false};
constexpr Enclosure any{-infinity, infinity, true};

/// With every rounding to float of relative error up to `error`.
Enclosure rounded(Enclosure x, FloatRange range, double error = half_ulp) {
  if (!has_numbers(x)) return x;
  if (std::isfinite(x.lo)) x.lo -= std::fabs(x.lo) * error;
  if (std::isfinite(x.hi)) x.hi += std::fabs(x.hi) * error;
  if (range.underflows && x.lo > 0 && x.lo < float_min) x.lo = 0;
  if (range.underflows && x.hi < 0 && x.hi > -float_min) x.hi = 0;
  if (range.overflows && x.hi > float_max) x.hi = infinity;
  if (range.overflows && x.lo < -float_max) x.lo = -infinity;
  return x;
}

Enclosure sum(const Enclosure& a, const Enclosure& b) {
  if (!has_numbers(a) || !has_numbers(b)) return {infinity, -infinity, true};
  Enclosure r{a.lo + b.lo, a.hi + b.hi, a.nan || b.nan};
  if ((a.hi == infinity && b.lo == -infinity) || (a.lo == -infinity && b.hi == infinity)) {
    r.nan = true;
  }
  if (std::isnan(r.lo)) r.lo = -infinity;
  if (std::isnan(r.hi)) r.hi = infinity;
  return r;
}

bool has_infinity(const Enclosure& x) { return x.lo == -infinity || x.hi == infinity; }
bool has_zero(const Enclosure& x) { return x.lo <= 0 && x.hi >= 0; }

Enclosure product(const Enclosure& a, const Enclosure& b) {
  if (!has_numbers(a) || !has_numbers(b)) return {infinity, -infinity, true};
  Enclosure r = none;
  for (const double x : {a.lo, a.hi}) {
    for (const double y : {b.lo, b.hi}) {
      const double z = x == 0 || y == 0 ? 0.0 : x * y;
      r = unite(r, exactly(z));
    }
  }
  const bool undefined = (has_zero(a) && has_infinity(b)) || (has_infinity(a) && has_zero(b));
  r.nan = a.nan || b.nan || undefined;
  return r;
}

Enclosure quotient(const Enclosure& a, const Enclosure& b) {
  if (!has_numbers(a) || !has_numbers(b)) return {infinity, -infinity, true};
  const bool undefined = (has_zero(a) && has_zero(b)) || (has_infinity(a) && has_infinity(b));
  Enclosure r = none;
  if (has_zero(b)) {
    r = any;
  } else {
    for (const double x : {a.lo, a.hi}) {
      for (const double y : {b.lo, b.hi}) {
        const bool both = std::isinf(x) && std::isinf(y);
        r = unite(r, both ? exactly(0.0) : exactly(x / y));
        if (both) r = unite(r, exactly(std::copysign(infinity, x) * std::copysign(1.0, y)));
      }
    }
  }
  r.nan = a.nan || b.nan || undefined;
  return r;
}

/// min and max: never decreasing in either operand, the second where one is NaN.
template <class F>
Enclosure lesser_or_greater(const Enclosure& a, const Enclosure& b, F&& f) {
  Enclosure r = none;
  if (has_numbers(a) && has_numbers(b)) r = {f(a.lo, b.lo), f(a.hi, b.hi), false};
  if (a.nan && has_numbers(b)) r = unite(r, {b.lo, b.hi, false});
  r.nan = b.nan;
  return r;
}

/// Of a function that never decreases and has a value everywhere in [low, high].
template <class F>
Enclosure rising(Enclosure x, F&& f, double low = -infinity, double high = infinity) {
  Enclosure r = none;
  r.nan = x.nan || (has_numbers(x) && (x.lo < low || x.hi > high));
  x.lo = std::max(x.lo, low);
  x.hi = std::min(x.hi, high);
  if (x.lo <= x.hi) r = {f(x.lo), f(x.hi), r.nan};
  return r;
}

Enclosure negated(const Enclosure& x) { return {-x.hi, -x.lo, x.nan}; }

/// Of a function with slopes and values in [-1, 1] that is NaN at infinities.
template <class F>
Enclosure wave(const Enclosure& x, F&& f) {
  const bool nan = x.nan || (has_numbers(x) && has_infinity(x));
  if (!has_numbers(x) || (std::isinf(x.lo) && x.lo == x.hi)) return {infinity, -infinity, true};
  if (std::isinf(x.lo) || std::isinf(x.hi)) return {-1.0, 1.0, nan};
  const double middle = f(x.lo);
  const double width = x.hi - x.lo;
  return {std::max(-1.0, middle - width), std::min(1.0, middle + width), nan};
}

Enclosure tangent(const Enclosure& x) {
  if (x.is_exact()) return exactly(std::tan(x.lo));
  if (!has_numbers(x) || !(x.hi - x.lo < 1.0)) return any;
  const bool has_pole = std::cos(x.lo) * std::cos(x.hi) <= 0;
  return has_pole ? any : Enclosure{std::tan(x.lo), std::tan(x.hi), x.nan};
}

/// f at the corners of the rectangle, where the extremes are.
template <class F>
Enclosure corners(const Enclosure& a, const Enclosure& b, F&& f) {
  Enclosure r = none;
  for (const double x : {a.lo, a.hi}) {
    for (const double y : {b.lo, b.hi}) r = unite(r, exactly(f(x, y)));
  }
  r.nan = r.nan || a.nan || b.nan;
  return r;
}

Enclosure power(const Enclosure& x, const Enclosure& y) {
  const auto f = [](double a, double b) { return std::pow(a, b); };
  if (x.is_exact() && y.is_exact()) return exactly(f(x.lo, y.lo));
  const bool smooth = has_numbers(x) && has_numbers(y) && x.lo > 0 && !has_infinity(x);
  return smooth && !has_infinity(y) ? corners(x, y, f) : any;
}

Enclosure angle(const Enclosure& y, const Enclosure& x) {
  const auto f = [](double b, double a) { return std::atan2(b, a); };
  if (x.is_exact() && y.is_exact()) return exactly(f(y.lo, x.lo));
  const bool nan = x.nan || y.nan;
  if (!has_numbers(x) || !has_numbers(y)) return {infinity, -infinity, true};
  const bool may_jump = has_zero(y) && x.lo <= 0;
  return may_jump || has_infinity(x) || has_infinity(y) ? Enclosure{-3.1415928, 3.1415928, nan}
                                                        : corners(y, x, f);
}

Enclosure transcendental(Op op, const Enclosure& a, const Enclosure& b) {
  switch (op) {
    case Op::sin: return wave(a, [](double x) { return std::sin(x); });
    case Op::cos: return wave(a, [](double x) { return std::cos(x); });
    case Op::tan: return tangent(a);
    case Op::asin: return rising(a, [](double x) { return std::asin(x); }, -1.0, 1.0);
    case Op::acos: return negated(rising(a, [](double x) { return -std::acos(x); }, -1.0, 1.0));
    case Op::atan2: return angle(a, b);
    case Op::exp: return rising(a, [](double x) { return std::exp(x); });
    case Op::exp2: return rising(a, [](double x) { return std::exp2(x); });
    case Op::log: return rising(a, [](double x) { return std::log(x); }, 0.0);
    case Op::log2: return rising(a, [](double x) { return std::log2(x); }, 0.0);
    default: return power(a, b);
  }
}

Enclosure absolute(const Enclosure& x) {
  if (!has_numbers(x)) return x;
  const double far = std::max(std::fabs(x.lo), std::fabs(x.hi));
  const double near = has_zero(x) ? 0.0 : std::min(std::fabs(x.lo), std::fabs(x.hi));
  return {near, far, x.nan};
}

/// The operations that round once.
Enclosure arithmetic(Op op, const Enclosure& a, const Enclosure& b, const Enclosure& c,
                     FloatRange range) {
  if (a.is_exact() && b.is_exact() && c.is_exact()) {
    switch (op) {
      case Op::add: return rounded_once(a.lo + b.lo, range);
      case Op::sub: return rounded_once(a.lo - b.lo, range);
      case Op::mul: return rounded_once(a.lo * b.lo, range);
      case Op::div: return rounded_once(a.lo / b.lo, range);
      case Op::fma: return rounded_once(std::fma(a.lo, b.lo, c.lo), range);
      default: return rounded_once(std::sqrt(a.lo), range);
    }
  }
  switch (op) {
    case Op::add: return rounded(sum(a, b), range);
    case Op::sub: return rounded(sum(a, negated(b)), range);
    case Op::mul: return rounded(product(a, b), range);
    case Op::div: return rounded(quotient(a, b), range);
    case Op::fma: return rounded(sum(product(a, b), c), range);
    default: return rounded(rising(a, [](double x) { return std::sqrt(x); }, 0.0), range);
  }
}

}  // namespace

bool Enclosure::contains(double x) const { return std::isnan(x) ? nan : lo <= x && x <= hi; }

bool Enclosure::is_narrow() const {
  if (nan || lo == hi) return !nan || lo > hi;
  const double least = lo > 0 || hi < 0 ? std::min(std::fabs(lo), std::fabs(hi)) : 0.0;
  return hi - lo <= std::max(1e-3 * least, 2 * float_min);
}

bool has_numbers(const Enclosure& x) { return x.lo <= x.hi; }

Enclosure unite(const Enclosure& a, const Enclosure& b) {
  return {std::min(a.lo, b.lo), std::max(a.hi, b.hi), a.nan || b.nan};
}

Enclosure exactly(double x) {
  return std::isnan(x) ? Enclosure{infinity, -infinity, true} : Enclosure{x, x, false};
}

/// Of operands that are exact: what is a float is the result of both engines, since the
/// rounding to double moves nothing onto a float or off it that rounding to float would not.
Enclosure rounded_once(double x, FloatRange range) {
  const bool is_float = std::isnan(x) || (static_cast<double>(static_cast<float>(x)) == x &&
                                          !(x != 0 && std::fabs(x) < float_min));
  return is_float ? exactly(x) : rounded(exactly(x), range);
}

Enclosure compute(Op op, const Enclosure& a, const Enclosure& b, const Enclosure& c,
                  FloatRange range) {
  switch (op) {
    case Op::min: return lesser_or_greater(a, b, [](double x, double y) { return std::min(x, y); });
    case Op::max: return lesser_or_greater(a, b, [](double x, double y) { return std::max(x, y); });
    case Op::neg: return negated(a);
    case Op::abs: return absolute(a);
    case Op::floor: return rising(a, [](double x) { return std::floor(x); });
    case Op::ceil: return rising(a, [](double x) { return std::ceil(x); });
    case Op::trunc: return rising(a, [](double x) { return std::trunc(x); });
    case Op::round: return rising(a, [](double x) { return std::nearbyint(x); });
    default: break;
  }
  if (is_transcendental(op)) return rounded(transcendental(op, a, b), range, 8 * half_ulp);
  return arithmetic(op, a, b, c, range);
}

}  // namespace nacre::testing
