#include "runtime/texture/texture_set.h"

namespace nacre {

TextureSet acquire_set(TextureStore& store, const TextureKey& pattern, Diagnostics& diagnostics) {
  const auto tiles = find_tiles(pattern.path, store.options().tiles, diagnostics);
  if (!tiles) return {};
  TextureSet set;
  set.directory = tile_directory(*tiles);
  set.textures.reserve(tiles->size());
  for (const TileFile& tile : *tiles) {
    set.textures.push_back(store.acquire({tile.path, pattern.layer, pattern.policy}, diagnostics));
  }
  return set;
}

}  // namespace nacre
