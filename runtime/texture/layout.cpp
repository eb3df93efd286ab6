#include "runtime/texture/layout.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace nacre::texture_layout {

namespace {

std::uint32_t as_word(int value) { return static_cast<std::uint32_t>(value); }
std::uint32_t as_word(float value) { return std::bit_cast<std::uint32_t>(value); }

}  // namespace

int level_count(int width, int height) {
  return std::bit_width(static_cast<unsigned>(std::max(width, height)));
}

Plan plan(TexelFormat format, int width, int height, int channels) {
  assert(width >= 1 && width <= max_size && height >= 1 && height <= max_size);
  assert(channels >= 1 && channels <= 4);
  constexpr int tile = 1 << tile_log2;
  constexpr std::uint64_t tile_texels = tile * tile;

  Plan result;
  result.format = format;
  result.channels = channels;
  result.width = width;
  result.height = height;
  result.levels = level_count(width, height);
  std::uint64_t next = header_words;
  for (int level = 0; level < result.levels; ++level) {
    const int across = (level_extent(width, level) + tile - 1) >> tile_log2;
    const int down = (level_extent(height, level) + tile - 1) >> tile_log2;
    const std::uint64_t row = static_cast<std::uint64_t>(across) * tile_texels
                              << texel_words_log2(format);
    const auto entry = static_cast<std::size_t>(level);
    result.level_start[entry] = static_cast<std::uint32_t>(next);
    result.level_row[entry] = static_cast<std::uint32_t>(row);
    next += row * static_cast<std::uint64_t>(down);
  }
  assert(next < (std::uint64_t{1} << 31));  // 16384^2 rgba32f with levels: 1.43e9.
  result.total_words = static_cast<std::uint32_t>(next);
  const auto last = static_cast<std::size_t>(result.levels - 1);
  for (std::size_t entry = last + 1; entry < max_levels; ++entry) {
    result.level_start[entry] = result.level_start[last];
    result.level_row[entry] = result.level_row[last];
  }
  return result;
}

void write_header(const Plan& plan, std::uint32_t flags, std::span<std::uint32_t> words) {
  assert(words.size() >= header_words);
  std::fill_n(words.begin(), header_words, 0u);
  words[word_magic] = magic_and_version;
  words[word_format] = static_cast<std::uint32_t>(plan.format);
  words[word_flags] = flags;
  words[word_channels] = as_word(plan.channels);
  words[word_width] = as_word(plan.width);
  words[word_height] = as_word(plan.height);
  words[word_width_float] = as_word(static_cast<float>(plan.width));
  words[word_height_float] = as_word(static_cast<float>(plan.height));
  words[word_level_count] = as_word(plan.levels);
  words[word_max_level_float] = as_word(static_cast<float>(plan.levels - 1));
  words[word_tile_log2] = as_word(tile_log2);
  words[word_texel_words_log2] = as_word(texel_words_log2(plan.format));
  words[word_total_words] = plan.total_words;
  words[word_image_width] = as_word(plan.width);
  words[word_image_height] = as_word(plan.height);
  for (int level = 0; level < max_levels; ++level) {
    const int source = std::min(level, plan.levels - 1);
    const auto entry = static_cast<std::size_t>(level);
    words[word_level_start + entry] = plan.level_start[entry];
    words[word_level_row + entry] = plan.level_row[entry];
    words[word_level_size + entry] = as_word(level_extent(plan.width, source)) |
                                     as_word(level_extent(plan.height, source)) << 16;
  }
}

}  // namespace nacre::texture_layout
