#pragma once

#include <array>
#include <cstdint>

#include "runtime/program/fold.h"
#include "runtime/texture/layout.h"

namespace nacre {

/// r, g, b, a.
using Rgba = std::array<float, 4>;

// half_to_float is that of runtime/program/fold.h. In integer steps, for a recorder: with m = h &
// 0x7fff and s = h & 0x8000, the bits of a normal half are (m << 13) + (112 << 23), those of a
// denormal one (m < 0x400) the bits of float(m) * 2^-24; then or s << 16. The store holds no
// infinite or NaN halves.

/// Nearest, ties to even; magnitudes above 65504 give 65504. Requires a finite value.
std::uint16_t float_to_half(float value);

/// A texel of the store: NaN and infinity give 0, denormals give 0. `replaced` counts
/// NaN and infinity. Works on bits, so the host's flush-to-zero state does not matter.
float sanitised(float value, std::uint64_t& replaced);

/// Writes the words of one texel. Values outside the range of an unsigned format
/// clamp; rounding is to nearest. Requires sanitised values.
void encode_texel(texture_layout::TexelFormat format, const Rgba& value, std::uint32_t* words);

/// The four components as the sampler sees them: r32f gives (r, 0, 0, 1).
Rgba decode_texel(texture_layout::TexelFormat format, const std::uint32_t* words);

}  // namespace nacre
