#pragma once

#include <memory>

#include "examples/tool/check/lobe_laws.h"
#include "jit/shading/shading_system.h"

namespace nacre::tool {

/// Tries the laws on the kernels of a material; no views where it has no closure.
LobeFindings try_lobes(std::unique_ptr<MaterialKernels> kernels, const LobeEffort& effort);

}  // namespace nacre::tool
