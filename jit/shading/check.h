#pragma once

#include "jit/shading/system_parts.h"

namespace nacre {

/// See ShadingSystem::check.
void check_shading(const Document& document, const SystemParts& parts, const ShaderOptions& options,
                   Diagnostics& diagnostics);

}  // namespace nacre
