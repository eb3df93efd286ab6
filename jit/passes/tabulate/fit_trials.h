#pragma once

#include <vector>

#include "runtime/program/program.h"

namespace nacre {

/// Values are fitted to what floats make of them, whose own roundings count.
inline constexpr double error_of_floats = 4;

/// Which functions of `maker` a fit is close to for most parameters, as far as a few trials tell:
/// the same for all documents, for code is shared by those that differ in such numbers alone.
/// `fit`: its range, and what is close.
std::vector<bool> close_on_trials(const Fit& fit, const Program& maker);

}  // namespace nacre
