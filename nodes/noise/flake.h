#pragma once

#include "runtime/node/node_call.h"
#include "runtime/value/vector.h"

namespace nacre {

/// Sets the outputs of flake2d and flake3d: flakes lie as cubes, randomly turned,
/// in the unit cells of position / size; where several cover a point, the one of
/// highest priority shows.
void record_flake(NodeCall& call, Float3 position);

}  // namespace nacre
