#pragma once

#include <cstdint>
#include <span>

#include "runtime/program/op.h"

namespace nacre {

/// One value of one point, as the reference engine has it: f of an f32, i of an i32, and of a
/// b1 as 0 or 1.
struct Value64 {
  double f = 0.0;
  std::uint32_t i = 0;
};

/// From and to the bits of an f32: denormals are zero, NaN is canonical_nan.
double float_of(std::uint32_t bits);
std::uint32_t bits_of(double value);

/// Towards zero, to the nearest number that there is; NaN to 0.
std::int32_t truncate_saturated(double value);

/// Some of the points that are worked on at once, by their numbers.
using Points64 = std::span<const std::uint32_t>;

/// An operation of floats that gives one, by the C library's functions: of the values at `points`
/// in three columns, whether or not it has as many operands.
void compute(Op op, Points64 points, const Value64* x, const Value64* y, const Value64* z,
             Value64* to);

/// A comparison of floats.
std::uint32_t compare(Op op, double a, double b);

}  // namespace nacre
