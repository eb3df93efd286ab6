#pragma once

#include <cstddef>
#include <functional>

#include "examples/render/scene.h"

namespace nacre::host {

/// Splits edges in the middle until none is too long, by its two ends in either order, in the space
/// of the mesh. Edges that meet are split alike, whatever triangle they are of, so nothing tears.
/// What vertices carry is interpolated. False where that would take more triangles than `most`:
/// then some are larger.
bool tessellate(Mesh& mesh, const std::function<bool(Vec3, Vec3)>& is_too_long, std::size_t most);

}  // namespace nacre::host
