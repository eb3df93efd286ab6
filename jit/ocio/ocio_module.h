#pragma once

#include <memory>
#include <string>

#include "jit/graph/color/color_config.h"
#include "runtime/module.h"

namespace nacre {

/// The module nacre_colors: all that needs OpenColorIO.
struct OcioModule : ModuleHead {
  /// What a file config.ocio has; null, with the reason in `fault`, if it cannot be read.
  std::shared_ptr<const ColorConfig> (*load)(const std::string& path, std::string& fault);
};

}  // namespace nacre
