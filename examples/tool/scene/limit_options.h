#pragma once

#include "examples/render/scene_limits.h"

namespace CLI {
class App;
}

namespace nacre::tool {

/// Options for what a scene may cost; they write to `limits`, which lives as long as `command`.
void add_scene_limits(CLI::App& command, host::SceneLimits& limits);

}  // namespace nacre::tool
