#pragma once

#include <cstddef>

#include "examples/render/medium.h"
#include "examples/render/shader.h"

namespace nacre::host {

/// What lanes say of a medium: finite, at least 0.
Medium medium_of(const InteriorLanes& lanes, std::size_t lane);
Medium medium_of(const VolumeLanes& lanes, std::size_t lane);

}  // namespace nacre::host
