#pragma once

#include <nacre/nacre.h>

#include <memory>

#include "jit/graph/color/color_config.h"

namespace nacre::api {

/// Colour spaces that a host defines.
std::shared_ptr<const ColorConfig> host_colors(const nacre_colors& given);

}  // namespace nacre::api
