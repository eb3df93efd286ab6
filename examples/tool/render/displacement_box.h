#pragma once

#include "examples/render/bounds.h"
#include "examples/render/shader.h"
#include "runtime/program/program.h"

namespace nacre::tool {

/// Where a displacement may move the points of triangles whose corners, all of them, are the lanes
/// of a batch: by interval arithmetic of what was recorded (jit/passes/range.h). Infinite where
/// nothing is known, as of images and of what hangs on the clock. What kernels round, at any
/// accuracy, is within.
host::Bounds displacement_box(const Program& recorded, const host::ShadingBatch& corners);

}  // namespace nacre::tool
