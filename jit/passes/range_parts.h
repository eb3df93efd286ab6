#pragma once

#include <array>
#include <cstddef>

#include "jit/passes/range.h"
#include "runtime/program/op.h"

namespace nacre {

// What is computed of one number alone, in several ways that come together again, is known far
// better part by part of that number's range: of x - x^2 over [0, 1] intervals say [-1, 1]. Within
// a part it goes no further from its middle than its derivative leads (R. E. Moore, "Interval
// Analysis", 1966, the mean value form).

/// Over one part: what it may be, what in the middle, and its derivative.
struct Part {
  Range value, middle, slope;
};

inline constexpr std::size_t part_count = 32;
using Parts = std::array<Part, part_count>;

/// The number itself, whose range is bounded, in equal parts.
Parts parts_of(const Range& whole);
/// What does not hang on it.
Part constant_part(const Range& value);
/// By the rules of sums and products; of another operation nothing is known.
Range slope_of(Op op, const std::array<Part, 3>& operands);
/// What the mean value form says of a part that is `half` wide to each side of its middle.
Range by_slope(const Range& middle, const Range& slope, double half);

}  // namespace nacre
