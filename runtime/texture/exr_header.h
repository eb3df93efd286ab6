#pragma once

#include <optional>
#include <string>

#include "runtime/texture/image_file.h"

namespace nacre {

/// Why the header of an OpenEXR file is not to be trusted; nothing if it is. OpenEXR
/// allocates what an attribute claims before it reads it, so every size is held against
/// the bytes that there are, and windows, tiles, channels and parts against the limits.
/// (OpenEXR File Layout; of what is inside attributes only what holds sizes of its own is
/// read.)
std::optional<std::string> exr_header_fault(const ImageFile& file, const ImageLimits& limits);

}  // namespace nacre
