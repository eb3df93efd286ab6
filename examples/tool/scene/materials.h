#pragma once

#include <vector>

#include "examples/render/scene.h"
#include "examples/tool/options.h"
#include "examples/tool/render/options.h"
#include "examples/tool/scene/assignment.h"

namespace nacre::tool {

/// Whether no document is given.
bool has_own_materials(const RenderOptions& options);

/// Whether what is asked for goes together; an error otherwise.
bool check_request(const RenderOptions& options, Diagnostics& diagnostics);

/// The scene's own materials as a document; also written, with images that are within the scene
/// file, where RenderOptions::document says. Empty pointers after an error.
Opened open_scene_materials(const RenderOptions& options, host::Scene& scene,
                            Diagnostics& diagnostics);

/// Of meshes that have a material of the scene: whether the camera sees their backs.
void take_sides(const host::Scene& scene, std::vector<MeshAssignment>& assignments);

}  // namespace nacre::tool
