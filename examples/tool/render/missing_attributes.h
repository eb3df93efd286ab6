#pragma once

#include <string>
#include <vector>

#include "examples/render/scene.h"
#include "examples/tool/render/kernel_shader.h"
#include "runtime/diagnostic.h"

namespace nacre::tool {

/// A mesh, what shades it, and how that is called.
struct ShadedMesh {
  const host::Mesh* mesh = nullptr;
  const KernelShader* shader = nullptr;
  std::string material;
};

/// A warning for each vertex attribute that a material reads and meshes it is on do not
/// have, with what is taken instead; one for all those meshes, at `scene_file`.
void report_missing_attributes(const std::vector<ShadedMesh>& meshes, const std::string& scene_file,
                               Diagnostics& diagnostics);

}  // namespace nacre::tool
