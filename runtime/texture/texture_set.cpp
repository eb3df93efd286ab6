#include "runtime/texture/texture_set.h"

namespace nacre {

TextureSet acquire_set(const TextureStore& store, const TextureKey& pattern,
                       Diagnostics& diagnostics,
                       const std::function<TextureHandle(const TextureKey& tile)>& acquire) {
  const auto tiles = find_tiles(pattern.path, store.options().tiles, diagnostics);
  if (!tiles) return {};
  TextureSet set;
  set.directory = tile_directory(*tiles);
  set.textures.reserve(tiles->size());
  for (const TileFile& tile : *tiles) {
    set.textures.push_back(acquire({tile.path, pattern.layer, pattern.policy}));
  }
  return set;
}

TextureSet acquire_set(TextureStore& store, const TextureKey& pattern, Diagnostics& diagnostics) {
  return acquire_set(store, pattern, diagnostics,
                     [&](const TextureKey& tile) { return store.acquire(tile, diagnostics); });
}

}  // namespace nacre
