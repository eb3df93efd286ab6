#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>

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
inline float sanitised(float value, std::uint64_t& replaced) {
  const std::uint32_t exponent = std::bit_cast<std::uint32_t>(value) & 0x7f800000u;
  const bool is_number = exponent != 0x7f800000u;
  replaced += is_number ? 0 : 1;
  return is_number && exponent != 0 ? value : 0.f;
}

/// Writes the words of texels that lie side by side. Values outside the range of an unsigned
/// format clamp; rounding is to nearest. Requires sanitised values.
void encode_texels(texture_layout::TexelFormat format, std::span<const Rgba> values,
                   std::uint32_t* words);

/// The four components of texels side by side as the sampler sees them: r32f gives (r, 0, 0, 1).
void decode_texels(texture_layout::TexelFormat format, const std::uint32_t* words,
                   std::span<Rgba> values);

/// The same of one texel.
/// @{
void encode_texel(texture_layout::TexelFormat format, const Rgba& value, std::uint32_t* words);
Rgba decode_texel(texture_layout::TexelFormat format, const std::uint32_t* words);
/// @}

/// Row y of a level, from the left: as many values as it has texels.
/// @{
void encode_row(const texture_layout::Plan& plan, int level, int y, std::span<const Rgba> values,
                std::uint32_t* words);
void decode_row(const texture_layout::Plan& plan, int level, int y, const std::uint32_t* words,
                std::span<Rgba> values);
/// @}

}  // namespace nacre
