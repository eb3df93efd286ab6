#include "runtime/texture/texel.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace nacre {

using texture_layout::TexelFormat;

namespace {

std::uint32_t unsigned_of(float value, float scale) {
  // By a signed number, which processors of old convert to as well.
  return static_cast<std::uint32_t>(
      static_cast<std::int32_t>(std::clamp(value, 0.f, 1.f) * scale + 0.5f));
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

namespace {

template <TexelFormat format>
constexpr std::size_t words_of = std::size_t{1} << texture_layout::texel_words_log2(format);

template <TexelFormat format>
void encode(const Rgba& value, std::uint32_t* words) {
  if constexpr (format == TexelFormat::r32f) {
    words[0] = std::bit_cast<std::uint32_t>(value[0]);
  } else if constexpr (format == TexelFormat::rgba8) {
    words[0] = unsigned_of(value[0], 255.f) | unsigned_of(value[1], 255.f) << 8 |
               unsigned_of(value[2], 255.f) << 16 | unsigned_of(value[3], 255.f) << 24;
  } else if constexpr (format == TexelFormat::rgba16) {
    words[0] = pair(unsigned_of(value[0], 65535.f), unsigned_of(value[1], 65535.f));
    words[1] = pair(unsigned_of(value[2], 65535.f), unsigned_of(value[3], 65535.f));
  } else if constexpr (format == TexelFormat::rgba16f) {
    words[0] = pair(float_to_half(value[0]), float_to_half(value[1]));
    words[1] = pair(float_to_half(value[2]), float_to_half(value[3]));
  } else {
    for (std::size_t c = 0; c < 4; ++c) words[c] = std::bit_cast<std::uint32_t>(value[c]);
  }
}

template <TexelFormat format>
Rgba decode(const std::uint32_t* words) {
  Rgba value{0.f, 0.f, 0.f, 1.f};
  if constexpr (format == TexelFormat::r32f) {
    value[0] = std::bit_cast<float>(words[0]);
  } else if constexpr (format == TexelFormat::rgba8) {
    for (std::size_t c = 0; c < 4; ++c) {
      const auto byte = static_cast<std::int32_t>(words[0] >> 8 * c & 0xffu);
      value[c] = static_cast<float>(byte) * (1.f / 255.f);
    }
  } else if constexpr (format == TexelFormat::rgba16) {
    for (std::size_t c = 0; c < 4; ++c) {
      const auto word = static_cast<std::int32_t>(words[c / 2] >> 16 * (c % 2) & 0xffffu);
      value[c] = static_cast<float>(word) * (1.f / 65535.f);
    }
  } else if constexpr (format == TexelFormat::rgba16f) {
    for (std::size_t c = 0; c < 4; ++c) {
      value[c] = half_to_float(static_cast<std::uint16_t>(words[c / 2] >> 16 * (c % 2)));
    }
  } else {
    for (std::size_t c = 0; c < 4; ++c) value[c] = std::bit_cast<float>(words[c]);
  }
  return value;
}

template <TexelFormat format>
void encode_all(std::span<const Rgba> values, std::uint32_t* words) {
  for (const Rgba& value : values) {
    encode<format>(value, words);
    words += words_of<format>;
  }
}

template <TexelFormat format>
void decode_all(const std::uint32_t* words, std::span<Rgba> values) {
  for (Rgba& value : values) {
    value = decode<format>(words);
    words += words_of<format>;
  }
}

/// Texels of a row that lie side by side: those of a tile.
template <class Run>
void for_runs(const texture_layout::Plan& plan, int level, int y, std::size_t width, Run run) {
  constexpr std::size_t side = std::size_t{1} << texture_layout::tile_log2;
  for (std::size_t x = 0; x < width; x += side) {
    run(x, std::min(side, width - x), texel_index(plan, level, static_cast<int>(x), y));
  }
}

}  // namespace

void encode_texels(TexelFormat format, std::span<const Rgba> values, std::uint32_t* words) {
  switch (format) {
    case TexelFormat::r32f: return encode_all<TexelFormat::r32f>(values, words);
    case TexelFormat::rgba8: return encode_all<TexelFormat::rgba8>(values, words);
    case TexelFormat::rgba16: return encode_all<TexelFormat::rgba16>(values, words);
    case TexelFormat::rgba16f: return encode_all<TexelFormat::rgba16f>(values, words);
    case TexelFormat::rgba32f: return encode_all<TexelFormat::rgba32f>(values, words);
  }
}

void decode_texels(TexelFormat format, const std::uint32_t* words, std::span<Rgba> values) {
  switch (format) {
    case TexelFormat::r32f: return decode_all<TexelFormat::r32f>(words, values);
    case TexelFormat::rgba8: return decode_all<TexelFormat::rgba8>(words, values);
    case TexelFormat::rgba16: return decode_all<TexelFormat::rgba16>(words, values);
    case TexelFormat::rgba16f: return decode_all<TexelFormat::rgba16f>(words, values);
    case TexelFormat::rgba32f: return decode_all<TexelFormat::rgba32f>(words, values);
  }
}

void encode_texel(TexelFormat format, const Rgba& value, std::uint32_t* words) {
  encode_texels(format, {&value, 1}, words);
}

Rgba decode_texel(TexelFormat format, const std::uint32_t* words) {
  Rgba value;
  decode_texels(format, words, {&value, 1});
  return value;
}

void encode_row(const texture_layout::Plan& plan, int level, int y, std::span<const Rgba> values,
                std::uint32_t* words) {
  for_runs(plan, level, y, values.size(), [&](std::size_t x, std::size_t count, std::size_t at) {
    encode_texels(plan.format, values.subspan(x, count), words + at);
  });
}

void decode_row(const texture_layout::Plan& plan, int level, int y, const std::uint32_t* words,
                std::span<Rgba> values) {
  for_runs(plan, level, y, values.size(), [&](std::size_t x, std::size_t count, std::size_t at) {
    decode_texels(plan.format, words + at, values.subspan(x, count));
  });
}

}  // namespace nacre
