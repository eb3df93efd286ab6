#pragma once

#include "runtime/program/program.h"

namespace nacre {

/// `program` with sin ... pow replaced by arithmetic that the engines have, at
/// the accuracy asked for (jit/passes/math/functions.h says what that is). The
/// result of an operation depends on nothing but its operands and the accuracy,
/// so a program and a slice of it agree bit for bit. Operations of one argument
/// share its reduction. To come after derive() and contract(): the expansions
/// contain error-free sums and products that contraction must not touch.
Program expand_math(const Program& program, Accuracy accuracy,
                    std::size_t most = std::size_t{1} << 31);

}  // namespace nacre
