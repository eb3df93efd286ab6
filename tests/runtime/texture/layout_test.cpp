#include "runtime/texture/layout.h"

#include <gtest/gtest.h>

#include <bit>
#include <set>
#include <utility>
#include <vector>

#include "runtime/texture/texel.h"

namespace nacre {
namespace {

using namespace texture_layout;

constexpr std::array formats{TexelFormat::r32f, TexelFormat::rgba8, TexelFormat::rgba16,
                             TexelFormat::rgba16f, TexelFormat::rgba32f};
constexpr std::array<std::pair<int, int>, 7> sizes{
    {{1, 1}, {1, 37}, {37, 1}, {17, 5}, {5, 17}, {64, 64}, {256, 256}}};

/// A value every format holds exactly, different for most texels.
Rgba texel_value(TexelFormat format, int level, int x, int y) {
  const auto part = [&](int a) {
    const int integer = (a * 31 + level * 7) & 0xff;
    if (format == TexelFormat::rgba8) return static_cast<float>(integer) * (1.f / 255.f);
    if (format == TexelFormat::rgba16) return static_cast<float>(integer * 257) * (1.f / 65535.f);
    return static_cast<float>(integer) - 100.f;
  };
  if (format == TexelFormat::r32f) return {part(x + 259 * y), 0.f, 0.f, 1.f};
  return {part(x), part(y), part(x + y), part(x - y)};
}

TEST(TextureLayout, EveryTexelRoundTripsInEveryFormatAndSize) {
  for (const TexelFormat format : formats) {
    for (const auto& [width, height] : sizes) {
      const Plan planned = plan(format, width, height, 4);
      std::vector<std::uint32_t> words(planned.total_words);
      const auto each = [&](auto&& visit) {
        for (int level = 0; level < planned.levels; ++level) {
          for (int y = 0; y < level_extent(height, level); ++y) {
            for (int x = 0; x < level_extent(width, level); ++x) {
              visit(level, x, y, texel_index(planned, level, x, y));
            }
          }
        }
      };
      each([&](int level, int x, int y, std::size_t at) {
        ASSERT_GE(at, static_cast<std::size_t>(header_words));
        ASSERT_LE(at + (std::size_t{1} << texel_words_log2(format)), words.size());
        encode_texel(format, texel_value(format, level, x, y), &words[at]);
      });
      each([&](int level, int x, int y, std::size_t at) {
        ASSERT_EQ(decode_texel(format, &words[at]), texel_value(format, level, x, y))
            << width << "x" << height << " level " << level << " at " << x << "," << y;
      });
    }
  }
}

TEST(TextureLayout, NoTwoTexelsShareAWord) {
  for (const TexelFormat format : formats) {
    for (const auto& [width, height] : sizes) {
      const Plan planned = plan(format, width, height, 4);
      std::set<std::size_t> seen;
      std::size_t texels = 0;
      for (int level = 0; level < planned.levels; ++level) {
        for (int y = 0; y < level_extent(height, level); ++y) {
          for (int x = 0; x < level_extent(width, level); ++x, ++texels) {
            seen.insert(texel_index(planned, level, x, y) >> texel_words_log2(format));
          }
        }
      }
      EXPECT_EQ(seen.size(), texels);
    }
  }
}

/// The address as the comment of layout.h tells a sampler to compute it: from header words.
std::size_t address_from_header(const std::vector<std::uint32_t>& words, int level, int x, int y) {
  const int tile = static_cast<int>(words[word_tile_log2]);
  const int mask = (1 << tile) - 1;
  const int x_part = ((x & ~mask) << tile) + (x & mask);
  const int y_part = (y & mask) << tile;
  const auto l = static_cast<std::size_t>(level);
  return words[word_level_start + l] +
         static_cast<std::uint32_t>(y >> tile) * words[word_level_row + l] +
         (static_cast<std::uint32_t>(x_part + y_part) << words[word_texel_words_log2]);
}

TEST(TextureLayout, HeaderAloneGivesTheAddressOfEveryTexel) {
  for (const TexelFormat format : formats) {
    for (const auto& [width, height] : sizes) {
      const Plan planned = plan(format, width, height, 3);
      std::vector<std::uint32_t> words(planned.total_words);
      write_header(planned, 0, words);
      const int levels = static_cast<int>(words[word_level_count]);
      ASSERT_EQ(levels, planned.levels);
      for (int level = 0; level < levels; ++level) {
        const std::uint32_t size = words[static_cast<std::size_t>(word_level_size + level)];
        for (int y = 0; y < static_cast<int>(size >> 16); ++y) {
          for (int x = 0; x < static_cast<int>(size & 0xffffu); ++x) {
            ASSERT_EQ(address_from_header(words, level, x, y), texel_index(planned, level, x, y));
          }
        }
      }
    }
  }
}

TEST(TextureLayout, HeaderSaysSizesAsIntegersAndFloats) {
  const Plan planned = plan(TexelFormat::rgba16f, 300, 77, 3);
  std::vector<std::uint32_t> words(header_words);
  write_header(planned, texture_missing, words);
  EXPECT_EQ(words[0], 0x4e545801u);
  EXPECT_EQ(words[1], 3u);
  EXPECT_EQ(words[2], 1u);
  EXPECT_EQ(words[3], 3u);
  EXPECT_EQ(words[4], 300u);
  EXPECT_EQ(words[5], 77u);
  EXPECT_EQ(std::bit_cast<float>(words[6]), 300.f);
  EXPECT_EQ(std::bit_cast<float>(words[7]), 77.f);
  EXPECT_EQ(words[8], 9u);  // 300 150 75 37 18 9 4 2 1
  EXPECT_EQ(std::bit_cast<float>(words[9]), 8.f);
  EXPECT_EQ(words[11], 1u);
  EXPECT_EQ(words[12], planned.total_words);
  EXPECT_EQ(words[48 + 2], 75u | 19u << 16);
}

TEST(TextureLayout, LevelsStartOnCacheLinesAndTablesRepeatTheLast) {
  for (const TexelFormat format : formats) {
    const Plan planned = plan(format, 19, 300, 4);
    std::vector<std::uint32_t> words(header_words);
    write_header(planned, 0, words);
    for (std::size_t l = 0; l < max_levels; ++l) {
      EXPECT_EQ(words[word_level_start + l] % 16, 0u);
      if (l < static_cast<std::size_t>(planned.levels)) continue;
      for (const int table : {word_level_start, word_level_row, word_level_size}) {
        const auto first = static_cast<std::size_t>(table);
        EXPECT_EQ(words[first + l], words[first + static_cast<std::size_t>(planned.levels) - 1]);
      }
    }
    EXPECT_EQ(words[word_level_size + max_levels - 1], 1u | 1u << 16);
  }
}

TEST(TextureLayout, LargestImageHasSignedWordIndices) {
  const Plan planned = plan(TexelFormat::rgba32f, max_size, max_size, 4);
  EXPECT_EQ(planned.levels, 15);
  EXPECT_LT(planned.total_words, 1u << 31);
  EXPECT_EQ(texel_index(planned, 0, max_size - 1, max_size - 1) + 4, planned.level_start[1]);
}

}  // namespace
}  // namespace nacre
