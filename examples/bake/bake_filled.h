#pragma once

#include "examples/bake/bake.h"

namespace nacre::host {

/// Bytes of the largest output that it is for: 16384 x 16384 texels of four components twice over.
inline constexpr double largest_filled = 0x1p33;

/// What bake() does, for a surface that does not fill its image: texels beside it get values as
/// `settings.dilation` says. They may be of any texel, so that the whole output is kept in memory,
/// 4 bytes for each texel and component, before the first block is handed over.
BakeResult bake_filled(const OutputKernel& kernel, std::size_t output, const BakeSettings& settings,
                       int block_rows, const RowSink& sink, const BakeControl& control = {},
                       BakeCounts* counts = nullptr);

}  // namespace nacre::host
