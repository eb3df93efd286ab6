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
/// Level `index`, 0..15, which may differ from lane to lane. After the
/// last level comes the last again. Fetches of the header.
MipLevel mip_level(const TexelFetch& fetch, Int index);
/// The word at which a texel of a level starts.
Int texel_word(const TexelFetch& fetch, const MipLevel& level, Int column, Int row);
/// The image at (u, v), as address() gives them, filtered within one level; in the
/// steps of the format.
Float4 filter_level(const TexelFetch& fetch, const MipLevel& level, Float u, Float v,
                    TextureModes modes);

/// a + t (b - a) of every component: exactly a where a and b are equal, so flat areas stay
/// flat. A component that is a literal in both is a's.
Float4 mix_steps(const Float4& a, const Float4& b, Float t);

}  // namespace nacre
