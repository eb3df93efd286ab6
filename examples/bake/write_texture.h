#pragma once

#include <string>

#include "examples/bake/bake.h"
#include "runtime/diagnostic.h"

namespace nacre::host {

/// Bakes one output into a file, atomically. The extension says what is written:
///
///   .exr  32-bit float, as computed
///   .png  8 bits, clamped to [0, 1]; colours with the sRGB transfer function
///   .tx   a tiled, mip-mapped 32-bit float texture
///
/// One channel for float, boolean and integer, else as many as the type has.
bool bake_to_file(const OutputKernel& kernel, std::size_t output, const BakeSettings& settings,
                  const std::string& path, Diagnostics& diagnostics,
                  const BakeControl& control = {});

}  // namespace nacre::host
