#include "jit/passes/range_parts.h"

#include <algorithm>
#include <cmath>

#include "jit/passes/range_arithmetic.h"

namespace nacre {

Parts parts_of(const Range& whole) {
  Parts parts;
  for (std::size_t k = 0; k < part_count; ++k) {
    const auto at = [&](double i) {
      const double share = i / static_cast<double>(part_count);
      return whole.low + share * (whole.high - whole.low);
    };
    const auto from = static_cast<double>(k);
    const double middle = at(from + 0.5);
    parts[k] = {.value = {at(from), k + 1 == part_count ? whole.high : at(from + 1), false},
                .middle = {middle, middle, false},
                .slope = {1, 1, false}};
  }
  return parts;
}

Part constant_part(const Range& value) { return {value, value, {0, 0, false}}; }

Range slope_of(Op op, const std::array<Part, 3>& in) {
  const auto of_product = [&] {
    return sum(product(in[0].slope, in[1].value), product(in[0].value, in[1].slope));
  };
  switch (op) {
    case Op::add: return sum(in[0].slope, in[1].slope);
    case Op::sub: return sum(in[0].slope, negated(in[1].slope));
    case Op::mul: return of_product();
    case Op::fma: return sum(of_product(), in[2].slope);
    case Op::neg: return negated(in[0].slope);
    default: return {};
  }
}

Range by_slope(const Range& middle, const Range& slope, double half) {
  const Range steps = product(slope, {-half, half, false});
  const Range around = sum(middle, steps);
  if (!around.is_bounded()) return {};
  // How wide the middle is by rounding alone counts twice, for it is as much elsewhere; and sums of
  // points are floats.
  constexpr double rounding = 1e-6;
  const double size = std::max(std::abs(middle.low), std::abs(middle.high)) + steps.high;
  const double room = middle.high - middle.low + rounding * size;
  return sum(around, {-room, room, false});
}

}  // namespace nacre
