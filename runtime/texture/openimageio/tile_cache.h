#pragma once

#include <cstdint>
#include <memory>

#include "runtime/texture/tile_cache.h"

namespace nacre {

/// One that is OpenImageIO's ImageCache.
std::shared_ptr<TileCache> make_image_cache(std::uint64_t budget_bytes, const ImageLimits& limits);

}  // namespace nacre
