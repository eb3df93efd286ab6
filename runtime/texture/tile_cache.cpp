#include "runtime/texture/tile_cache.h"

#include "runtime/texture/image_module.h"

namespace nacre {

std::shared_ptr<TileCache> TileCache::make(std::uint64_t budget_bytes, const ImageLimits& limits) {
  Diagnostic error;
  const ImageModule* const module = image_module({}, error);
  return module == nullptr ? nullptr : module->make_tile_cache(budget_bytes, limits);
}

}  // namespace nacre
