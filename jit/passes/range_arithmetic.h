#pragma once

#include "jit/passes/range.h"
#include "runtime/program/program.h"

namespace nacre {

// Interval arithmetic of floats and of integers, with room for rounding. What is not bounded gives
// what nothing is known of, where no more is said.

Range hull(const Range& a, const Range& b);
Range intersection(const Range& a, const Range& b);
/// One number that is known.
bool is_point(const Range& a);
bool has_zero(const Range& a);
bool may_be_minus_zero(const Range& a);
/// How far the farther end is from 0.
double largest_size(const Range& a);

/// How far the results of floats are from what numbers give.
enum class Rounding {
  about,       ///< By a few units in the last place, as estimates are.
  to_nearest,  ///< By half of one at most: what is between two floats stays between them.
  none,        ///< Not at all: of what is rounded later.
};

Range sum(const Range& a, const Range& b, Rounding rounding = Rounding::about);
Range negated(const Range& a);
Range product(const Range& a, const Range& b, Rounding rounding = Rounding::about);
Range square(const Range& a, Rounding rounding = Rounding::about);
Range quotient(const Range& a, const Range& b, Rounding rounding = Rounding::about);
/// fma(t, b, fma(-t, a, a)): between a and b for t in [0, 1], which sums and products forget.
Range mixed(const Range& a, const Range& b, const Range& t);
/// a < b ? a : b, and a > b ? a : b: of NaN the second.
/// @{
Range least(const Range& a, const Range& b);
Range most(const Range& a, const Range& b);
/// @}
Range absolute(const Range& a);
Range root(const Range& a, Rounding rounding = Rounding::about);
Range floored(const Range& a);
/// Of x - floor(x), which rounds to 1 just below a whole number.
Range fraction(const Range& x);
/// Of Op::exp, whose kernels need not round right.
Range exponential(const Range& a);
Range of_table(const Table& table);
/// Of an i32 as a float, and of a u32.
/// @{
Range of_signed(const Range& a);
Range of_unsigned();
/// @}

/// Of Op::f_to_i.
Range whole(const Range& a);
// Of integers, which wrap around: nothing is known of what may.
Range integer_sum(const Range& a, const Range& b);
Range integer_product(const Range& a, const Range& b);
/// Of Op::lshr and Op::iand.
/// @{
Range integer_shift(const Range& a, const Range& count);
Range integer_and(const Range& a, const Range& b);
/// @}

}  // namespace nacre
