#pragma once

#include "examples/bake/bake.h"
#include "runtime/diagnostic.h"
#include "runtime/texture/texture_store.h"

namespace nacre::host {

/// The kernel of an output with those tiles of image sets, of all that ShaderOptions::defer_tiles
/// has left for later, that points of the plane may read. Images that nothing holds any more make
/// room for them where there are many.
OutputKernel with_tiles(const OutputKernel& kernel, std::size_t output,
                        const BakeSettings& settings, TextureStore& textures,
                        Diagnostics& diagnostics);

}  // namespace nacre::host
