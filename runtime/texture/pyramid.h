#pragma once

#include <cstdint>
#include <span>

#include "runtime/texture/layout.h"

namespace nacre {

/// Fills levels 1.. of a texture whose level 0 is in place.
///
/// Level l+1 is the area average of level l: a texel covers width_l / width_{l+1}
/// texels across, which is 2 for even sizes and 2 + 1/width_{l+1} for odd ones; texels
/// it covers in part count in proportion (Guthe and Heckbert, "Non-Power-of-Two
/// Mipmap Creation", NVIDIA 2005). So every level has the mean of the image. Averages
/// are taken in float on the stored, linear values, and level l+1 sees level l before
/// rounding to the format. No texel outside the image takes part: the pyramid is the
/// same whatever the address mode.
///
/// Needs a temporary of 4 floats for a quarter of the texels.
void build_pyramid(const texture_layout::Plan& plan, std::span<std::uint32_t> words);

}  // namespace nacre
