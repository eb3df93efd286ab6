#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "runtime/diagnostic.h"
#include "runtime/texture/texture_store.h"
#include "runtime/texture/tile_set.h"

namespace nacre {

/// A set of textures that a point chooses among by floor(u), floor(v): what a file name
/// with <UDIM> or <UVTILE> means. A kernel binds `textures` to consecutive slots.
struct TextureSet {
  std::vector<std::uint32_t> directory;  ///< See tile_directory; empty if nothing was found.
  std::vector<TextureHandle> textures;   ///< By the numbers the directory holds.
};

/// All tiles of a name, each as `acquire` gives it, never null. A tile that cannot be read
/// is missing in its own right, with a diagnostic, and does not disturb the others. Limits
/// are those of the store.
TextureSet acquire_set(const TextureStore& store, const TextureKey& pattern,
                       Diagnostics& diagnostics,
                       const std::function<TextureHandle(const TextureKey& tile)>& acquire);

/// The same, with every tile from the store.
TextureSet acquire_set(TextureStore& store, const TextureKey& pattern, Diagnostics& diagnostics);

}  // namespace nacre
