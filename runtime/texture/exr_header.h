#pragma once

#include <optional>

#include "runtime/diagnostic.h"
#include "runtime/texture/image_file.h"

namespace nacre {

/// Why the header of an OpenEXR file is not to be trusted; nothing if it is. OpenEXR
/// allocates what an attribute claims before it reads it, so every size is held against
/// the bytes that there are, and windows, tiles, channels and parts against the limits.
/// (OpenEXR File Layout; of what is inside attributes only what holds sizes of its own is
/// read.) Errors: broken-image; image-too-large for windows outside the limits.
std::optional<Diagnostic> check_exr_header(const ImageFile& file, const ImageLimits& limits);

}  // namespace nacre
