#include "jit/passes/range_arithmetic.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace nacre {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Larger than what rounding to float moves a number by, in parts of it.
constexpr double rounding_about = 1e-6;
/// Larger than what rounding to double does.
constexpr double rounding_of_double = 0x1p-51;

/// Wider by what floats round, which makes zero of what is denormal and infinities of what is
/// large. No end is a NaN.
Range rounded(double low, double high, bool nan = false) {
  constexpr double largest = 1e38, smallest = 1.2e-38;
  low = std::min(low, largest), high = std::max(high, -largest);
  low -= rounding_about * std::abs(low);
  high += rounding_about * std::abs(high);
  if (low > 0 && low < smallest) low = 0;
  if (high < 0 && high > -smallest) high = 0;
  return {low < -largest ? -infinity : low, high > largest ? infinity : high, nan};
}

/// To the nearest float, which is no more than that of any larger number.
double nearest_float(double x) {
  constexpr double largest = std::numeric_limits<float>::max();
  if (std::abs(x) > largest) return std::copysign(infinity, x);
  return static_cast<float>(x);
}

Range rounded(Rounding how, double low, double high, bool nan) {
  if (how == Rounding::about) return rounded(low, high, nan);
  constexpr double smallest = std::numeric_limits<float>::min();
  // NaN comes of infinities alone, which stay.
  if (std::isfinite(low)) low -= rounding_of_double * std::abs(low);
  if (std::isfinite(high)) high += rounding_of_double * std::abs(high);
  if (how == Rounding::none) return {low, high, nan};
  // What is denormal is 0, or rounds to the smallest that is not.
  if (std::abs(low) < smallest) low = low < 0 ? -smallest : 0;
  if (std::abs(high) < smallest) high = high > 0 ? smallest : 0;
  return {nearest_float(low), nearest_float(high), nan};
}

/// Of integers, which wrap around: nothing is known of what may.
Range integers(double low, double high) {
  return low >= -0x1p31 && high < 0x1p31 ? Range{low, high, false} : Range{};
}

bool has_infinity(const Range& a) { return a.low == -infinity || a.high == infinity; }

/// Of what is monotonic in each operand, at the ends of both; `nan` where some numbers of the two
/// give NaN, and what others near them give is about 0.
template <class Operation>
Range of_corners(const Range& a, const Range& b, bool nan, Rounding how,
                 const Operation& operation) {
  Range range{infinity, -infinity, nan || a.nan || b.nan};
  for (const double x : {a.low, a.high}) {
    for (const double y : {b.low, b.high}) {
      const double corner = operation(x, y);
      range.low = std::min(range.low, std::isnan(corner) ? 0 : corner);
      range.high = std::max(range.high, std::isnan(corner) ? 0 : corner);
    }
  }
  return rounded(how, range.low, range.high, range.nan);
}

}  // namespace

double largest_size(const Range& a) { return std::max(std::abs(a.low), std::abs(a.high)); }

bool Range::is_bounded() const { return !nan && low > -infinity && high < infinity; }

bool has_zero(const Range& a) { return a.low <= 0 && a.high >= 0; }

bool may_be_minus_zero(const Range& a) { return a.minus_zero && has_zero(a); }

bool is_point(const Range& a) { return a.is_bounded() && a.low == a.high; }

Range hull(const Range& a, const Range& b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high), a.nan || b.nan};
}

Range intersection(const Range& a, const Range& b) {
  return {std::max(a.low, b.low), std::min(a.high, b.high), a.nan && b.nan};
}

Range sum(const Range& a, const Range& b, Rounding rounding) {
  // Of infinities of two signs.
  const bool nan = a.nan || b.nan || (a.high == infinity && b.low == -infinity) ||
                   (a.low == -infinity && b.high == infinity);
  const bool falls = a.low == -infinity || b.low == -infinity;
  const bool rises = a.high == infinity || b.high == infinity;
  return rounded(rounding, falls ? -infinity : a.low + b.low, rises ? infinity : a.high + b.high,
                 nan);
}

Range negated(const Range& a) { return {-a.high, -a.low, a.nan}; }

Range product(const Range& a, const Range& b, Rounding rounding) {
  return of_corners(a, b, (has_zero(a) && has_infinity(b)) || (has_infinity(a) && has_zero(b)),
                    rounding, [](double x, double y) { return x * y; });
}

Range square(const Range& a, Rounding rounding) {
  const Range size = absolute(a);
  Range squared = product(size, size, rounding);
  squared.nan = a.nan;  // No zero meets an infinity.
  return squared;
}

Range quotient(const Range& a, const Range& b, Rounding rounding) {
  if (has_zero(b)) return {};  // Of either sign.
  return of_corners(a, b, has_infinity(a) && has_infinity(b), rounding,
                    [](double x, double y) { return x / y; });
}

Range mixed(const Range& a, const Range& b, const Range& t) {
  if (!a.is_bounded() || !b.is_bounded() || !t.is_bounded()) return {};
  // Straight in each of the three: what is least and most is at ends.
  double low = infinity, high = -infinity;
  for (const double share : {t.low, t.high}) {
    const auto [from, to] = std::minmax({(1 - share) * a.low, (1 - share) * a.high});
    const auto [least, most] = std::minmax({share * b.low, share * b.high});
    low = std::min(low, from + least);
    high = std::max(high, to + most);
  }
  // What (1 - t) a rounds by may be more than the sum has digits for.
  const double lost = rounding_about * (largest_size(a) * (1 + largest_size(t)));
  return rounded(low - lost, high + lost);
}

Range least(const Range& a, const Range& b) {
  return {std::min(a.low, b.low), a.nan ? b.high : std::min(a.high, b.high), b.nan};
}
Range most(const Range& a, const Range& b) {
  return {a.nan ? b.low : std::max(a.low, b.low), std::max(a.high, b.high), b.nan};
}

Range absolute(const Range& a) {
  return {has_zero(a) ? 0.0 : std::min(std::abs(a.low), std::abs(a.high)), largest_size(a), a.nan};
}

Range root(const Range& a, Rounding rounding) {
  if (a.low < 0) return {0, infinity, true};
  return rounded(rounding, std::sqrt(a.low), std::sqrt(a.high), a.nan);
}

Range floored(const Range& a) {
  return a.is_bounded() ? Range{std::floor(a.low), std::floor(a.high), false} : Range{};
}

Range fraction(const Range& x) { return x.is_bounded() ? Range{0, 1, false} : Range{}; }

Range exponential(const Range& a) {
  const Range exact = rounded(std::exp(a.low), std::exp(a.high), a.nan);
  return rounded(exact.low, exact.high, a.nan);
}

Range of_table(const Table& table) {
  const auto [low, high] = std::ranges::minmax(table.values);
  if (!std::isfinite(low) || !std::isfinite(high)) return {};
  // Nothing rounds what stands there, but what is denormal counts as 0.
  const auto stands = [](float x) { return x == 0 || std::isnormal(x); };
  return stands(low) && stands(high) ? Range{low, high, false} : rounded(low, high);
}

Range of_signed(const Range& a) {
  return a.is_bounded() ? rounded(a.low, a.high) : rounded(-0x1p31, 0x1p31);
}

Range of_unsigned() { return rounded(0, 0x1p32); }

Range whole(const Range& a) {
  if (!a.is_bounded()) return {};
  const auto clamped = [](double x) { return std::clamp(std::trunc(x), -0x1p31, 0x1p31 - 1); };
  return {clamped(a.low), clamped(a.high), false};
}

Range integer_sum(const Range& a, const Range& b) {
  return a.is_bounded() && b.is_bounded() ? integers(a.low + b.low, a.high + b.high) : Range{};
}

Range integer_product(const Range& a, const Range& b) {
  if (!a.is_bounded() || !b.is_bounded()) return {};
  const auto [low, high] =
      std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
  return integers(low, high);
}

Range integer_shift(const Range& a, const Range& count) {
  if (!a.is_bounded() || a.low < 0 || !is_point(count) || count.low < 0 || count.low > 31) {
    return {};
  }
  const double by = std::exp2(count.low);
  return {std::floor(a.low / by), std::floor(a.high / by), false};
}

Range integer_and(const Range& a, const Range& b) {
  double most = infinity;
  for (const Range& each : {a, b}) {
    if (each.is_bounded() && each.low >= 0) most = std::min(most, each.high);
  }
  return most < infinity ? Range{0, most, false} : Range{};
}

}  // namespace nacre
