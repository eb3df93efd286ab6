#pragma once

#include <span>
#include <vector>

#include "jit/passes/range.h"

namespace nacre {

/// Which of Program::textures may be read where so much is known of each of its inputs: of tile
/// sets those tiles whose cells a point may lie in, and all other images.
std::vector<bool> reached_textures(const Program& program, std::span<const Range> inputs);

}  // namespace nacre
