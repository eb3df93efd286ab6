#include "runtime/texture/texel.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace nacre {

using texture_layout::TexelFormat;

namespace {

std::uint32_t unsigned_of(float value, float scale) {
  return static_cast<std::uint32_t>(std::clamp(value, 0.f, 1.f) * scale + 0.5f);
}

std::uint32_t pair(std::uint32_t low, std::uint32_t high) { return low | high << 16; }

}  // namespace

std::uint16_t float_to_half(float value) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
  const std::uint32_t sign = bits >> 16 & 0x8000u;
  const float magnitude = std::min(std::fabs(value), 65504.f);
  if (magnitude < 0x1p-14f) {
    // Adding 2^-1 leaves a unit in the last place of 2^-24, one step of a denormal half.
    const float shifted = magnitude + 0.5f;
    return static_cast<std::uint16_t>(sign | (std::bit_cast<std::uint32_t>(shifted) & 0x7ffu));
  }
  const std::uint32_t m = std::bit_cast<std::uint32_t>(magnitude) - (112u << 23);
  const std::uint32_t rounded = m + 0x0fffu + (m >> 13 & 1u);
  return static_cast<std::uint16_t>(sign | rounded >> 13);
}

float sanitised(float value, std::uint64_t& replaced) {
  const std::uint32_t exponent = std::bit_cast<std::uint32_t>(value) & 0x7f800000u;
  if (exponent == 0x7f800000u) {
    ++replaced;
    return 0.f;
  }
  return exponent == 0 ? 0.f : value;
}

void encode_texel(TexelFormat format, const Rgba& value, std::uint32_t* words) {
  switch (format) {
    case TexelFormat::r32f: words[0] = std::bit_cast<std::uint32_t>(value[0]); break;
    case TexelFormat::rgba8:
      words[0] = unsigned_of(value[0], 255.f) | unsigned_of(value[1], 255.f) << 8 |
                 unsigned_of(value[2], 255.f) << 16 | unsigned_of(value[3], 255.f) << 24;
      break;
    case TexelFormat::rgba16:
      words[0] = pair(unsigned_of(value[0], 65535.f), unsigned_of(value[1], 65535.f));
      words[1] = pair(unsigned_of(value[2], 65535.f), unsigned_of(value[3], 65535.f));
      break;
    case TexelFormat::rgba16f:
      words[0] = pair(float_to_half(value[0]), float_to_half(value[1]));
      words[1] = pair(float_to_half(value[2]), float_to_half(value[3]));
      break;
    case TexelFormat::rgba32f:
      for (std::size_t c = 0; c < 4; ++c) words[c] = std::bit_cast<std::uint32_t>(value[c]);
      break;
  }
}

Rgba decode_texel(TexelFormat format, const std::uint32_t* words) {
  Rgba value{0.f, 0.f, 0.f, 1.f};
  switch (format) {
    case TexelFormat::r32f: value[0] = std::bit_cast<float>(words[0]); break;
    case TexelFormat::rgba8:
      for (std::size_t c = 0; c < 4; ++c) {
        value[c] = static_cast<float>(words[0] >> 8 * c & 0xffu) * (1.f / 255.f);
      }
      break;
    case TexelFormat::rgba16:
      for (std::size_t c = 0; c < 4; ++c) {
        value[c] = static_cast<float>(words[c / 2] >> 16 * (c % 2) & 0xffffu) * (1.f / 65535.f);
      }
      break;
    case TexelFormat::rgba16f:
      for (std::size_t c = 0; c < 4; ++c) {
        value[c] = half_to_float(static_cast<std::uint16_t>(words[c / 2] >> 16 * (c % 2)));
      }
      break;
    case TexelFormat::rgba32f:
      for (std::size_t c = 0; c < 4; ++c) value[c] = std::bit_cast<float>(words[c]);
      break;
  }
  return value;
}

}  // namespace nacre
