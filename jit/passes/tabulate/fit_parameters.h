#pragma once

#include <vector>

#include "runtime/program/program.h"

namespace nacre {

/// `program` with what depends on one bounded number and on parameters read from polynomials that
/// are fitted when the parameters are known (Program::fits): as tabulate() does it with what
/// depends on the number alone. What fits for most parameters is found by trials that are the same
/// for all documents (fit_trials.h), what does for those of a call when they are fitted: each value
/// that is read by itself. Where they are not close, and where nobody fits them, the kernel
/// computes. Nothing is fitted where there are more fits than Fit::most. After tabulate(), before
/// expand_math: the makers want it too. `slots`: of each whether it counts; of others, what depends
/// on them is computed.
Program fit_parameters(const Program& program, double error, std::vector<bool> slots);

}  // namespace nacre
