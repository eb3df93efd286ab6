#pragma once

#include <functional>

#include "tests/pbs/battery/lobe_kernels.h"
#include "tests/support/tier.h"

namespace nacre {

/// T-CHI, T-NORM, T-WGT and T-FUR of a lobe: samples, density and scattering function are one thing
/// seen from three sides. Fails the running test.
void try_lobe(const LobeCase& row, Accuracy accuracy, const Tier& tier);

/// Calls for each roughness and wo that a lobe is tried with, each with a seed of its own.
using LobeViewCheck = std::function<void(float roughness, Direction wo, std::uint64_t seed)>;
void each_lobe_view(const LobeCase& row, const Tier& tier, const LobeViewCheck& check);

/// How many chi-squares try_lobe makes, over all rows and accuracies.
int lobe_chi_squares();

}  // namespace nacre
