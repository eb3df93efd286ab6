#pragma once

#include <cstddef>

#include "examples/render/media.h"
#include "examples/render/shader.h"

namespace nacre::host {

/// What lanes say of a medium: finite, at least 0.
Medium medium_of(const InteriorLanes& lanes, std::size_t lane);
Medium medium_of(const VolumeLanes& lanes, std::size_t lane);
/// Of a solid, with vacuum around; of index 1 where there is no number.
Dielectric dielectric_of(const InteriorLanes& lanes, std::size_t lane, int priority);

}  // namespace nacre::host
