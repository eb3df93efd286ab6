#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace nacre {

/// By channel, r g b a: what all texels have, in steps of the format (TexelFetch::texel). Nothing
/// where they differ, and of channels that the image does not have.
using UniformChannels = std::array<std::optional<float>, 4>;

/// Of level 0 of a resident texture; the others are means of it. `words` as layout.h describes
/// them. Stops where all channels are known to differ: mostly in the first row.
UniformChannels uniform_channels(std::span<const std::uint32_t> words);

}  // namespace nacre
