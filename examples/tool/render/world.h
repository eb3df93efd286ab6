#pragma once

#include <optional>

#include "examples/render/environment.h"
#include "examples/render/scene.h"
#include "examples/tool/render/options.h"

namespace nacre::tool {

/// The environment that is asked for; nothing after an error.
std::optional<host::Environment> load_environment(const RenderOptions& options,
                                                  Diagnostics& diagnostics);

/// The scene as it stands at RenderSettings::time, with a camera, one without a name that sees it
/// where it has none, and the floor that is put below. Without meshes after an error.
host::Scene load_world(const RenderOptions& options, Diagnostics& diagnostics);

/// One of its cameras with the lens that is asked for.
host::Camera with_lens(const RenderOptions& options, const host::SceneCamera& camera);

}  // namespace nacre::tool
