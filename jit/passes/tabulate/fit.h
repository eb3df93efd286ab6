#pragma once

#include <span>
#include <vector>

#include "runtime/kernel.h"
#include "runtime/program/program.h"

namespace nacre {

/// Of each of a fit's functions its values at all numbers that fits look at. `maker`: a kernel of
/// Fit::maker; `parameters`: a slot each of it. Empty where it does not run to its end.
std::vector<std::vector<float>> fit_values(const Fit& fit, const Kernel& maker,
                                           std::span<const std::uint32_t> parameters);

/// Writes what Op::fitted reads of one function, four rows, by its values. False, and not all is
/// written, where the polynomials are further off than Fit::error times the larger of a value and a
/// hundredth of the largest (floor_of_peak).
bool fit_cells(const Fit& fit, std::span<const float> values, std::span<float> rows);

}  // namespace nacre
