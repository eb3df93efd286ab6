#pragma once

#include "nodes/texture2d/address.h"
#include "nodes/texture2d/texel_fetch.h"

namespace nacre {

/// One mip level of a texture, as runtime/texture/layout.h keeps it.
struct MipLevel {
  Int start;  ///< Its first word.
  Int row;    ///< Words in one row of tiles.
  Extent x;
  Extent y;
};

/// Level 0: uniform where the slot is.
MipLevel finest_level(const TexelFetch& fetch);
/// Level `index`, 0..14, which may differ from lane to lane. One fetch of the header.
MipLevel mip_level(const TexelFetch& fetch, Int index);
/// The level after `level`, which is level `index`; the last again after the last.
MipLevel coarser_level(const TexelFetch& fetch, const MipLevel& level, Int index);

/// The image at (u, v), as address() gives them, filtered within one level; in the
/// steps of the format.
Float4 filter_level(const TexelFetch& fetch, const MipLevel& level, Float u, Float v,
                    TextureModes modes);

}  // namespace nacre
