#pragma once

#include <vector>

#include "runtime/program/program.h"

namespace nacre::measure {

/// What a channel holds at the points of a batch, the same in every run: positions in
/// [-4, 4]^3, orthonormal frames around z, viewer and light above the surface, texture
/// coordinates in [0, 1]^2 with a footprint of 1/1024, other numbers in [0.05, 0.95].
std::vector<float> shading_points(const Channel& channel);

}  // namespace nacre::measure
