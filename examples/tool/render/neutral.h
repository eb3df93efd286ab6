#pragma once

#include <memory>

#include "jit/shading/shading_system.h"

namespace nacre::tool {

/// A diffuse grey for what no material names: a Lambertian reflectance of 0.4.
std::unique_ptr<MaterialKernels> neutral_material(ShadingSystem& system,
                                                  const ShaderOptions& options,
                                                  Diagnostics& diagnostics);

}  // namespace nacre::tool
