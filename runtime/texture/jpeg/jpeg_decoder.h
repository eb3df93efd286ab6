#pragma once

#include <memory>
#include <optional>

#include "runtime/diagnostic.h"
#include "runtime/stop.h"
#include "runtime/texture/image_file.h"
#include "runtime/texture/image_io.h"
#include "runtime/texture/image_module.h"

namespace nacre {

/// Opens a JPEG by libjpeg alone, which is there at once, where OpenImageIO has 250 libraries to
/// load. The samples are those that OpenImageIO has, whose reader is the same libjpeg. Grey and
/// three colours; null without a problem for what else a JPEG may be, and where a layer is named:
/// that is OpenImageIO's.
std::unique_ptr<ImageDecoder> open_jpeg(std::shared_ptr<const ImageFile> file,
                                        const std::string& layer, const ImageLimits& limits,
                                        ImageExtent extent, const Stop& stop, ImageInfo& info,
                                        std::optional<Diagnostic>& problem);

}  // namespace nacre
