#pragma once

#include <string>

#include "runtime/diagnostic.h"

namespace nacre::tool {

/// "256" or "640x480" in pixels, each 1 to 65536; false with an error otherwise.
bool parse_size(const std::string& text, int& width, int& height, Diagnostics& diagnostics);

}  // namespace nacre::tool
