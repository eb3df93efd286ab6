#pragma once

#include <vector>

#include "runtime/program/program.h"

namespace nacre {

/// `program` with what depends on one bounded number and on parameters read from polynomials that
/// are fitted when the parameters are known (Program::fits): as tabulate() does it with what
/// depends on the number alone, by plans that are made for the parameters as the document has them.
/// Whether they are close for others too is found when they are fitted; where they are not, and
/// where nobody fits them, the kernel computes. After tabulate(), before expand_math: the makers
/// want it too.
/// `slots`: of each whether it counts; of others, what depends on them is computed.
Program fit_parameters(const Program& program, double error, std::vector<bool> slots);

}  // namespace nacre
