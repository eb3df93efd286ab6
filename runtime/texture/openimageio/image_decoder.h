#pragma once

#include <memory>

#include "runtime/texture/image_module.h"

namespace nacre {

/// One that reads with OpenImageIO what open_input lets through.
std::unique_ptr<ImageDecoder> make_image_decoder();

}  // namespace nacre
