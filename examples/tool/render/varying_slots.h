#pragma once

#include <string>
#include <vector>

#include "examples/render/scene.h"

namespace nacre::tool {

/// ShaderOptions::varying of a material that is on these meshes, whose points are shaded
/// together: the matrices of objects; for geometric properties that some of the meshes have and
/// others lack, the slots that say which; and while the shutter is open, time and frame.
std::vector<std::string> varying_slots(const std::vector<const host::Mesh*>& meshes,
                                       bool is_shutter_open);

}  // namespace nacre::tool
