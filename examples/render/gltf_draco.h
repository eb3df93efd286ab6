#pragma once

#include "examples/render/gltf_accessor.h"
#include "examples/render/scene_budget.h"

namespace nacre::host {

/// Unpacks a primitive of KHR_draco_mesh_compression, if it is one, so that its accessors can be
/// read. False after an error.
bool unpack_draco(const GltfValue& root, const GltfValue& primitive, GltfBuffers& buffers,
                  GltfAccessors& accessors, SceneBudget& budget);

}  // namespace nacre::host
