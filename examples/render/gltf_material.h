#pragma once

#include "examples/render/gltf_dropped.h"
#include "examples/render/gltf_texture.h"
#include "examples/render/gltf_value.h"
#include "examples/render/scene_material.h"

namespace nacre::host {

/// Reads the material of a glTF file with its extensions; those that are not known are warned of.
/// What is wrong is an error, and counts as if it was not there.
SceneMaterial read_material(const GltfValue& material, GltfTextures& textures,
                            GltfDropped& dropped);

}  // namespace nacre::host
