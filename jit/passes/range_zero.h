#pragma once

#include <array>

#include "jit/passes/range.h"
#include "runtime/program/program.h"

namespace nacre {

/// Of an instruction's operands; of those that there are not nothing is read.
using OperandRanges = std::array<Range, 3>;

/// Whether the result of an operation may be -0, where its range says that it is not negative:
/// else it may be what was rounded away. Of sums both have to be +0, since x + 0 is x.
bool gives_minus_zero(const Instruction& x, const OperandRanges& in);

}  // namespace nacre
