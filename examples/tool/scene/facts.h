#pragma once

#include <vector>

#include "examples/render/scene.h"
#include "jit/compile/facts.h"

namespace nacre::tool {

/// What the renderer knows of all points that it shades on such meshes, whatever the scene: few
/// facts, and the same ones in most scenes, so that code in the cache serves them.
std::vector<Fact> scene_facts(const std::vector<const host::Mesh*>& meshes);

}  // namespace nacre::tool
