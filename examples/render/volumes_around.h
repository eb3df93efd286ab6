#pragma once

#include "examples/render/media.h"
#include "examples/render/render_context.h"

namespace nacre::host {

/// The volumes and solids that a point is inside of, at a time of a ray: those whose borders a ray
/// from there leaves and did not enter before. Of meshes without a border of their own; at most as
/// many as Media holds, the outermost.
Media volumes_around(const RenderContext& context, Vec3 P, float time);

}  // namespace nacre::host
