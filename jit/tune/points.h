#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/program/program.h"

namespace nacre {

/// What a channel holds at points to measure at, the same in every run: positions in
/// [-4, 4]^3, orthonormal frames around z, viewer and light above the surface, texture
/// coordinates in [0, 1]^2 with a footprint of 1/1024, other numbers in [0.05, 0.95]. Sets of other
/// numbers are other points of the same kind.
std::vector<float> shading_points(const Channel& channel, std::size_t count, std::uint32_t set = 0);

}  // namespace nacre
