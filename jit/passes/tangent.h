#pragma once

#include <array>

#include "runtime/program/op.h"
#include "runtime/value/value.h"

namespace nacre {

/// One operation y = op(x...) and the tangents d of its operands. Operands
/// that are no floats hold 0; a tangent that is known to vanish is a literal 0.
struct TangentStep {
  Bool condition = false;  ///< Of select.
  std::array<Float, 3> x;
  std::array<Float, 3> d;
  Float y;
};

/// Gives the tangent of y. Where an operation has no derivative (sqrt at 0,
/// a division by 0, ...) its own is defined to be 0; at a kink (abs at 0, min
/// of equals) it is that of the operand which y came from.
using TangentRule = Float (*)(const TangentStep& step);

/// The rule of an operation, or null where its result is piecewise constant
/// (floor, table, from_bits, ...), no float, or defined by other means
/// (structure, leaves, calls).
TangentRule tangent_rule(Op op);

}  // namespace nacre
