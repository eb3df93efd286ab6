#include "runtime/texture/uniform_channels.h"

#include <algorithm>
#include <bit>
#include <cstddef>

#include "runtime/program/fold.h"
#include "runtime/texture/layout.h"

namespace nacre {

using namespace texture_layout;

namespace {

constexpr std::size_t most_words = 4;  ///< Of a texel.
using Texel = std::array<std::uint32_t, most_words>;

/// The bits of a channel: of which word, from which bit, how many.
struct Field {
  std::size_t word;
  int first, width;

  std::uint32_t of(const Texel& texel) const {
    const std::uint32_t shifted = texel[word] >> first;
    return width == 32 ? shifted : shifted & ((1u << width) - 1u);
  }
};
Field field_of(TexelFormat format, std::size_t channel) {
  switch (format) {
    case TexelFormat::r32f:
    case TexelFormat::rgba32f: return {channel, 0, 32};
    case TexelFormat::rgba8: return {0, static_cast<int>(8 * channel), 8};
    case TexelFormat::rgba16:
    case TexelFormat::rgba16f: return {channel / 2, static_cast<int>(16 * (channel % 2)), 16};
  }
  return {};
}

float step_of(TexelFormat format, std::uint32_t bits) {
  switch (format) {
    case TexelFormat::r32f:
    case TexelFormat::rgba32f: return std::bit_cast<float>(bits);
    case TexelFormat::rgba8:
    case TexelFormat::rgba16: return static_cast<float>(bits);
    case TexelFormat::rgba16f: return half_to_float(static_cast<std::uint16_t>(bits));
  }
  return 0;
}

}  // namespace

UniformChannels uniform_channels(std::span<const std::uint32_t> words) {
  const auto format = static_cast<TexelFormat>(words[word_format]);
  const auto channels = static_cast<std::size_t>(words[word_channels]);
  const std::size_t width = words[word_width], height = words[word_height];
  const auto texel_log2 = static_cast<std::size_t>(texel_words_log2(format));
  const std::size_t texel_words = std::size_t{1} << texel_log2;
  constexpr std::size_t side = std::size_t{1} << tile_log2;

  Texel first{}, differs{};
  std::copy_n(words.begin() + words[word_level_start], texel_words, first.begin());
  const auto is_uniform = [&](std::size_t c) { return field_of(format, c).of(differs) == 0; };
  const auto any_is = [&] {
    for (std::size_t c = 0; c < channels; ++c) {
      if (is_uniform(c)) return true;
    }
    return false;
  };
  for (std::size_t y = 0; y < height && any_is(); ++y) {
    const std::size_t row = words[word_level_start] + (y >> tile_log2) * words[word_level_row];
    for (std::size_t x = 0; x < width; x += side) {
      // The row of a tile: its texels lie side by side.
      const std::size_t place = (x << tile_log2) + ((y & (side - 1)) << tile_log2);
      const auto* const texels = words.data() + row + (place << texel_log2);
      const std::size_t count = std::min(side, width - x) << texel_log2;
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t k = i & (texel_words - 1);
        differs[k] |= texels[i] ^ first[k];
      }
    }
  }

  UniformChannels uniform;
  for (std::size_t c = 0; c < channels; ++c) {
    if (is_uniform(c)) uniform[c] = step_of(format, field_of(format, c).of(first));
  }
  return uniform;
}

}  // namespace nacre
