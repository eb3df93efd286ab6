#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

/// The resident texture: ONE array of 32-bit words, 64-byte aligned, that a
/// kernel reads with a single primitive ("word i of texture t"). The header
/// comes first, the texels of all mip levels follow in tiles. Version 1.
///
/// Header, 64 words (four cache lines):
///
///   word   type   meaning
///   0      u32    magic_and_version
///   1      u32    TexelFormat
///   2      u32    flags: texture_missing | texture_by_call
///   3      i32    channels of the image that the store kept, 1..4
///   4      i32    width of level 0, 1..16384
///   5      i32    height of level 0
///   6      f32    width of level 0
///   7      f32    height of level 0
///   8      i32    number of levels, 1..15; the last is 1x1
///   9      f32    number of levels - 1: the upper bound of a level of detail
///   10     i32    log2 of the tile side, always tile_log2 in this version
///   11     i32    log2 of the words of one texel: 0, 1 or 2
///   12     i32    words of the whole array, header included; below 2^31
///   13     i32    width of the image in the file: word 4, except when looked up by calls
///   14     i32    height of the image in the file
///   15     0      reserved
///   16+l   i32    level l: index of its first word, a multiple of 16
///   32+l   i32    level l: words in one row of tiles
///   48+l   u32    level l: width | height << 16
///
/// Each level table is one cache line and one 16-lane register, so a level that
/// varies from lane to lane is a register permute. Entries past the last level
/// repeat it: a level index needs clamping to 15 for safety, no further.
///
/// Level l has max(1, width >> l) by max(1, height >> l) texels: the sizes can
/// be computed by shifts instead of loaded.
///
/// ORIENTATION: row y = 0 is the BOTTOM row of the image, so uv (0,0) is the
/// lower left corner (MaterialX Standard Nodes, "image") and the sampler flips
/// nothing: the centre of texel (x, y) has u = (x + 1/2) / width and
/// v = (y + 1/2) / height.
///
/// ADDRESS of texel (x, y) of level l, T = tile_log2, m = 2^T - 1, s = word 11.
/// It is a sum of a part in x and a part in y, so a 2x2 footprint needs two of
/// each and four additions:
///
///   x_part = ((x & ~m) << T) + (x & m)
///   y_part = ((y & m) << T)                             in texels
///   word   = header[16+l] + (y >> T) * header[32+l] + ((x_part + y_part) << s)
///
/// Texels of a tile that lie outside the level are zero and never addressed.
///
/// TEXELS, component 0 in the lowest bits of the first word. c channels are
/// kept; components beyond them hold 0 and the fourth holds 1 (`image`: missing
/// channels are zero; alpha of an opaque image is one):
///
///   r32f     1 word   float. A one-channel image; the sampler supplies (r, 0, 0, 1).
///   rgba8    1 word   bytes; value = byte * (1/255)
///   rgba16   2 words  unsigned 16 bit; value = integer * (1/65535)
///   rgba16f  2 words  IEEE half; see half_to_float for the integer steps
///   rgba32f  4 words  float
///
/// Values are what the file holds: no colour transform and no division or
/// multiplication by alpha. MaterialX transforms colour after filtering, in the
/// node graph, so sRGB is not the store's business. Every texel is finite: NaN and
/// infinity became 0. No f32 texel is denormal (they became 0); a denormal half
/// is kept, since its value is a normal float.
///
/// Why these choices (Zen 4, W = 16, bilinear rgba8, ns per lookup along rows /
/// along columns / random, image 4096^2 = 64 MB; the recorded sampler's arithmetic
/// written by hand):
///
///   no tiles 2.8 / 10.5 / 23      4x4 2.95 / 3.5 / 21.6     8x8 2.98 / 3.1 / 22
///   16x16 2.97 / 3.2 / 20         4x4 tiles inside 32x32: 3.2 / 3.5 / 22
///
/// Untiled rows cost 4 to 6 times as much when the walk turns; 8x8 is level with
/// 16x16 and pads small levels less; two levels of tiles never earn their address
/// arithmetic. One-channel 8-bit images are widened to r32f: packed bytes took
/// 3.1 ns where r32f took 2.2 (the byte extraction), and won only for random access
/// far out of cache (12 against 18 ns), at a quarter of the memory. With r32f every
/// texture costs at most what an RGBA image of its size costs, one decoder fewer is
/// recorded, and 16-bit height fields stay exact.
namespace nacre::texture_layout {

/// How the words of a texel hold its components.
enum class TexelFormat : std::uint32_t {
  r32f = 0,
  rgba8 = 1,
  rgba16 = 2,
  rgba16f = 3,
  rgba32f = 4
};

/// Word 0 of every array.
inline constexpr std::uint32_t magic_and_version = 0x4e545801;  // "NTX" and version 1
/// Texels begin behind them.
inline constexpr int header_words = 64;
inline constexpr int max_levels = 16;   ///< Entries of a table; 15 are enough for 16384.
inline constexpr int max_size = 16384;  ///< Texels of either side.
inline constexpr int tile_log2 = 3;     ///< Tiles are 8 x 8 texels.
inline constexpr int alignment = 64;    ///< Bytes, of the array.

/// Flag: no image could be read. The array then is one 1x1 r32f level holding 0;
/// the sampler returns the node's default.
inline constexpr std::uint32_t texture_missing = 1u << 0;
/// Flag: texels are not here (a 1x1 placeholder is); look up through its TextureSampler.
/// Everything but words 13 and 14 describes the placeholder, so a stray fetch stays
/// inside the array.
inline constexpr std::uint32_t texture_by_call = 1u << 1;

/// Indices of header words.
enum Word : int {
  word_magic = 0,
  word_format = 1,
  word_flags = 2,
  word_channels = 3,
  word_width = 4,
  word_height = 5,
  word_width_float = 6,
  word_height_float = 7,
  word_level_count = 8,
  word_max_level_float = 9,
  word_tile_log2 = 10,
  word_texel_words_log2 = 11,
  word_total_words = 12,
  word_image_width = 13,
  word_image_height = 14,
  word_level_start = 16,
  word_level_row = 32,
  word_level_size = 48,
};

/// log2 of the words of one texel.
constexpr int texel_words_log2(TexelFormat format) {
  switch (format) {
    case TexelFormat::r32f: return 0;
    case TexelFormat::rgba8: return 0;
    case TexelFormat::rgba16: return 1;
    case TexelFormat::rgba16f: return 1;
    case TexelFormat::rgba32f: return 2;
  }
  return 0;
}

/// The step of a format that means 1: the largest of an integer format.
constexpr float step_of_one(TexelFormat format) {
  switch (format) {
    case TexelFormat::rgba8: return 255.0f;
    case TexelFormat::rgba16: return 65535.0f;
    default: return 1.0f;
  }
}

/// Texels of a level where level 0 has `extent`.
constexpr int level_extent(int extent, int level) {
  return (extent >> level) > 1 ? extent >> level : 1;
}

/// floor(log2(max(width, height))) + 1.
int level_count(int width, int height);

/// What the header says, computed before anything is allocated.
struct Plan {
  TexelFormat format = TexelFormat::r32f;  ///< Of all levels.
  int channels = 1;                        ///< That are kept: 1..4.
  int width = 1;                           ///< Of level 0.
  int height = 1;                          ///< Of level 0.
  int levels = 1;                          ///< The last is 1x1.
  /// First words, by level; past the last that of the last.
  std::array<std::uint32_t, max_levels> level_start{};
  std::array<std::uint32_t, max_levels> level_row{};  ///< Words in one row of tiles, by level.
  std::uint32_t total_words = header_words;           ///< The header included.

  /// Of the whole array.
  std::uint64_t bytes() const { return std::uint64_t{total_words} * 4; }
};

/// Requires 1 <= width, height <= max_size and 1 <= channels <= 4.
Plan plan(TexelFormat format, int width, int height, int channels);

/// Writes the 64 header words; the image in the file is as large as level 0.
void write_header(const Plan& plan, std::uint32_t flags, std::span<std::uint32_t> words);

/// Index of the first word of texel (x, y) of a level. The scalar statement of the
/// address above; requires 0 <= x < width and 0 <= y < height of that level.
inline std::size_t texel_index(const Plan& plan, int level, int x, int y) {
  constexpr int mask = (1 << tile_log2) - 1;
  const int x_part = ((x & ~mask) << tile_log2) + (x & mask);
  const int y_part = (y & mask) << tile_log2;
  const std::size_t in_row = static_cast<std::size_t>(x_part + y_part)
                             << texel_words_log2(plan.format);
  const std::size_t row = static_cast<std::size_t>(y >> tile_log2);
  const auto entry = static_cast<std::size_t>(level);
  return plan.level_start[entry] + row * plan.level_row[entry] + in_row;
}

}  // namespace nacre::texture_layout
