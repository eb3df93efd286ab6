#pragma once

#include "runtime/kernel.h"
#include "tests/pbs/battery/narrow_case.h"
#include "tests/support/tier.h"

namespace nacre {

/// T-CHI-X, and T-NORM and T-WGT with it: samples of a narrow lobe against its own density, both on
/// the spheres of its warp. Fails the running test.
void try_narrow_lobe(const NarrowCase& row, Accuracy accuracy, const Tier& tier);

/// The probability of what a lobe of one width samples, by what the density of another one claims.
double narrow_probability(const NarrowCase& row, float sampled, float claimed);

/// How many chi-squares that are, over all rows and accuracies, where the tier is whole.
int narrow_chi_squares();

}  // namespace nacre
