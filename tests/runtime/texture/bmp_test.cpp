// BMP of every depth, packing and header, and what is wrong with some.
#include <array>
#include <chrono>

#include "tests/runtime/texture/bytes_as_image.h"
#include "tests/runtime/texture/hostile_image.h"

namespace nacre {
namespace {

using Pixels = std::vector<int>;

class Bmp : public BytesAsImage {};

// Red, green, blue and white in palettes of four bytes, and as two rows of two, the lower
// one first. Bytes are blue, green, red.
const std::string palette("\0\0\xff\0\0\xff\0\0\xff\0\0\0\xff\xff\xff\0", 16);
const std::string rows("\0\0\xff\0\xff\0\0\0\xff\0\0\xff\xff\xff\0\0", 16);
const Pixels picture{0, 0, 255, 255, 255, 255, 255, 0, 0, 0, 255, 0};

TEST_F(Bmp, RowsGoFromTheBottomToTheTopUnlessTheHeightIsNegative) {
  EXPECT_EQ(pixels_of(bmp({.width = 2, .height = 2}, rows)), picture);
  const std::string turned = rows.substr(8) + rows.substr(0, 8);
  EXPECT_EQ(pixels_of(bmp({.width = 2, .height = -2}, turned)), picture);
}

TEST_F(Bmp, EveryDepth) {
  const std::string four("\1\2\3\0\4\5\6\7", 8);
  EXPECT_EQ(pixels_of(bmp({.width = 2, .bits = 32}, four)), (Pixels{3, 2, 1, 0, 6, 5, 4, 7}));
  const BmpFields palettes{.width = 2, .height = 2, .bits = 8, .colors = 4};
  EXPECT_EQ(pixels_of(bmp(palettes, {"\0\1\0\0\2\3\0\0", 8}, palette)), picture);
  BmpFields fields = palettes;
  fields.bits = 4;
  EXPECT_EQ(pixels_of(bmp(fields, {"\x01\0\0\0\x23\0\0\0", 8}, palette)), picture);
  fields.bits = 1;
  fields.colors = 0;
  EXPECT_EQ(pixels_of(bmp(fields, {"\x40\0\0\0\x80\0\0\0", 8}, palette.substr(0, 8))),
            (Pixels{0, 255, 0, 255, 0, 0, 255, 0, 0, 0, 255, 0}));
  // Numbers of colours that there are not mean the last.
  EXPECT_EQ(pixels_of(bmp({.bits = 8, .colors = 2}, {"\xff\0\0\0", 4}, palette.substr(0, 8))),
            (Pixels{0, 255, 0}));
}

TEST_F(Bmp, GreyPalettesMakeOneChannel) {
  const std::string grey("\x10\x10\x10\0\x80\x80\x80\0", 8);
  const BmpFields fields{.width = 2, .bits = 8, .colors = 2};
  EXPECT_EQ(pixels_of(bmp(fields, {"\1\0\0\0", 4}, grey)), (Pixels{128, 16}));
}

TEST_F(Bmp, SixteenBitsHaveFiveOfEachOrMasks) {
  const std::string pixels("\x1f\x7c\xff\x7f", 4);  // 0x7c1f, 0x7fff
  EXPECT_EQ(pixels_of(bmp({.width = 2, .bits = 16}, pixels)), (Pixels{255, 0, 255, 255, 255, 255}));
  BmpFields fields{.width = 2, .bits = 16, .packing = 3, .masks = {0xf800, 0x7e0, 0x1f}};
  // 0b01111'100000'11111 and 0b01111'111111'11111.
  const Pixels of_masks{123, 130, 255, 123, 255, 255};
  for (const std::uint32_t size : {40u, 52u, 56u, 108u, 124u}) {
    fields.header_size = size;
    EXPECT_EQ(pixels_of(bmp(fields, pixels)), of_masks) << size;
  }
  // Without that packing what a longer header has of masks means nothing.
  fields.packing = 0;
  EXPECT_EQ(pixels_of(bmp(fields, pixels)), (Pixels{255, 0, 255, 255, 255, 255}));
  for (const auto& masks : std::vector<std::vector<std::uint32_t>>{{0, 0x7e0, 0x1f},
                                                                   {0xf800, 0xffe0, 0x1f},
                                                                   {0xf000, 0x7a0, 0x1f},
                                                                   {0x1f0000, 0x7e0, 0x1f},
                                                                   {0xffffffff, 0, 0}}) {
    EXPECT_EQ(code_of(bmp({.bits = 16, .packing = 3, .masks = masks}, pixels)), "broken-image");
  }
}

TEST_F(Bmp, ThirtyTwoBitsHaveTheUsualMasksOnly) {
  const std::string pixel("\1\2\3\4", 4);
  BmpFields fields{
      .header_size = 56, .bits = 32, .packing = 3, .masks = {0xff0000, 0xff00, 0xff, 0xff000000}};
  EXPECT_EQ(pixels_of(bmp(fields, pixel)), (Pixels{3, 2, 1, 4}));
  fields.masks = {0xff000000, 0xff0000, 0xff00, 0xff};
  EXPECT_EQ(code_of(bmp(fields, pixel)), "unsupported-image");
}

TEST_F(Bmp, EveryHeader) {
  for (const std::uint32_t size : {40u, 52u, 56u, 108u, 124u}) {
    const BmpFields fields{.header_size = size, .width = 2, .height = 2};
    EXPECT_EQ(pixels_of(bmp(fields, rows)), picture) << size;
  }
  const BmpFields core{.header_size = 12, .width = 2, .height = 2};
  EXPECT_EQ(pixels_of(bmp(core, rows)), picture);
  // Its palette has three bytes a colour, and as many as there is room for.
  const BmpFields indexed{.header_size = 12, .width = 2, .bits = 4};
  EXPECT_EQ(pixels_of(bmp(indexed, {"\x12\0\0\0", 4}, "abcdefghi")),
            (Pixels{'f', 'e', 'd', 'i', 'h', 'g'}));
  for (const std::uint32_t size : {16u, 41u, 64u, 65536u + 40u}) {
    EXPECT_EQ(code_of(bmp({.header_size = size, .width = 2, .height = 2}, rows)),
              "unsupported-image");
  }
}

TEST_F(Bmp, PixelsMayBeginLaterThanThePaletteEnds) {
  const BmpFields fields{.pixels_at = 14 + 40 + 8 + 5, .bits = 8, .colors = 2};
  EXPECT_EQ(pixels_of(bmp(fields, std::string(5, '\x7f') + std::string("\1\0\0\0", 4),
                          palette.substr(0, 8))),
            (Pixels{0, 255, 0}));
}

TEST_F(Bmp, Runs) {
  BmpFields fields{.width = 4, .height = 3, .bits = 8, .packing = 1, .colors = 4};
  // Two of colour 1 and three one by one, of which the last is past the line's end; a line
  // of nothing; one pixel over and one up... and what is left out is colour 0.
  const std::string runs("\2\1\0\3\2\3\1\0\0\0\0\2\1\0\0\0\3\2\0\0\0\1", 22);
  const auto colors = [](std::initializer_list<int> numbers) {
    const int rgb[4][3] = {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {255, 255, 255}};
    Pixels all;
    for (const int each : numbers) all.insert(all.end(), rgb[each], rgb[each] + 3);
    return all;
  };
  EXPECT_EQ(pixels_of(bmp(fields, runs, palette)), colors({2, 2, 2, 0, 0, 0, 0, 0, 1, 1, 2, 3}));
  const std::string grey("\x10\x10\x10\0\x20\x20\x20\0\x30\x30\x30\0\x40\x40\x40\0", 16);
  EXPECT_EQ(pixels_of(bmp(fields, runs, grey)),
            (Pixels{48, 48, 48, 16, 16, 16, 16, 16, 32, 32, 48, 64}));
  fields.bits = 4;
  fields.packing = 2;
  const std::string nibbles("\3\x12\0\5\x31\x23\x10\0\0\0\4\x30\0\0\0\2\2\0\2\x11\0\1", 22);
  EXPECT_EQ(pixels_of(bmp(fields, nibbles, palette)), colors({0, 0, 1, 1, 3, 0, 3, 0, 1, 2, 1, 3}));
}

TEST_F(Bmp, WrongRuns) {
  BmpFields fields{.width = 4, .height = 2, .bits = 8, .packing = 1, .colors = 4};
  EXPECT_EQ(code_of(bmp(fields, {"\4\1\0\0\4\1\0\0\4\1\0\1", 12}, palette)), "broken-image");
  EXPECT_NE(found_.find("more rows"), std::string::npos) << found_;
  EXPECT_EQ(code_of(bmp(fields, {"\0\2\0\xff\4\1\0\1", 8}, palette)), "broken-image");
  std::string idle;
  for (int i = 0; i < 100'000; ++i) idle.append("\0\2\0\0", 4);
  EXPECT_EQ(code_of(bmp(fields, idle + std::string("\0\1", 2), palette)), "broken-image");
  EXPECT_NE(found_.find("more data"), std::string::npos) << found_;
  fields.height = -2;
  EXPECT_EQ(code_of(bmp(fields, {"\0\1", 2}, palette)), "broken-image");
  // Runs of what has no palette.
  for (const std::uint32_t bits : {1u, 4u, 16u, 24u, 32u}) {
    EXPECT_EQ(code_of(bmp({.bits = bits, .packing = 1}, {"\0\1\0\0\0\0", 6}, palette)),
              "broken-image");
  }
  // A quarter of a billion pixels of nothing.
  const BmpFields large{.width = 16384, .height = 16384, .bits = 8, .packing = 1, .colors = 4};
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(code_of(bmp(large, {"\0\1", 2}, palette)), "broken-image");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
}

TEST_F(Bmp, WrongSizesAndPlaces) {
  const auto code = [&](BmpFields fields) { return code_of(bmp(fields, rows, palette)); };
  constexpr std::int32_t most = 0x7fffffff, least = -most - 1;
  for (const std::int32_t each : {0, -1, most, least, 16385}) {
    EXPECT_EQ(code({.width = each}), "image-too-large") << each;
    EXPECT_EQ(code({.height = each}), each == -1 ? "" : "image-too-large") << each;
  }
  EXPECT_EQ(code({.width = 16384, .height = 16384}), "broken-image");
  EXPECT_EQ(code({.width = 16384, .height = 16384, .bits = 32}), "broken-image");
  for (const std::uint32_t at : {1u, 17u, 53u, 1000u, 0x7fffffffu, 0xffffffffu}) {
    EXPECT_EQ(code({.pixels_at = at}), "broken-image") << at;
    EXPECT_EQ(code({.pixels_at = at, .bits = 8, .colors = 4}), "broken-image") << at;
  }
  EXPECT_EQ(code({.pixels_at = 54, .bits = 8, .colors = 4}), "broken-image");  // Over the palette.
  for (const std::uint32_t colors : {5u, 257u, 0x7fffffffu, 0xffffffffu}) {
    EXPECT_EQ(code({.bits = 8, .colors = colors}), "broken-image") << colors;
  }
  EXPECT_EQ(code({.bits = 8}), "broken-image");  // 256 colours, of which there are four.
  for (const std::uint32_t bits : {0u, 2u, 5u, 48u, 64u, 0xffffu}) {
    EXPECT_EQ(code({.bits = bits}), "unsupported-image") << bits;
  }
  // JPEG and PNG for printers, masks with alpha, and nothing.
  for (const std::uint32_t packing : {4u, 5u, 6u, 11u, 0xffffffffu}) {
    EXPECT_EQ(code({.packing = packing}), "unsupported-image") << packing;
  }
}

TEST_F(Bmp, CutAnywhereItIsBroken) {
  const BmpFields plain{.width = 2, .height = 2}, core{.header_size = 12, .width = 2, .height = 2};
  const BmpFields runs{.width = 4, .height = 1, .bits = 8, .packing = 1, .colors = 4};
  const BmpFields masks{.width = 2, .bits = 16, .packing = 3, .masks = {0xf800, 0x7e0, 0x1f}};
  for (const std::string& whole : {bmp(plain, rows), bmp(core, rows), bmp(masks, "abcd"),
                                   bmp(runs, {"\2\1\0\3\1\2\3\0\0\1", 10}, palette)}) {
    ASSERT_EQ(code_of(whole), "") << found_;
    for (std::size_t size = 1; size < whole.size(); ++size) {
      EXPECT_EQ(code_of(whole.substr(0, size)), size < 18 ? "unsupported-image" : "broken-image")
          << size;
    }
  }
}

/// Sanitizers look.
TEST_F(Bmp, AnyByteMayBeAnything) {
  const BmpFields plain{.width = 3, .height = 2, .bits = 8, .colors = 4};
  const BmpFields runs{.header_size = 124, .width = 4, .height = 1, .bits = 4, .packing = 2};
  const BmpFields masks{.width = 3, .bits = 16, .packing = 3, .masks = {0xf800, 0x7e0, 0x1f}};
  ImageLimits limits;
  limits.max_size = 128;
  for (const std::string& whole :
       {bmp(plain, {"\0\1\2\0\3\1\0\0", 8}, palette), bmp(masks, "abcdefgh"),
        bmp(runs, {"\2\1\0\3\1\2\3\0\0\1", 10}, palette + palette + palette + palette)}) {
    ASSERT_EQ(code_of(whole), "") << found_;
    for (std::size_t at = 0; at < whole.size(); ++at) {
      for (const char value : {'\0', '\3', '\x80', '\xff'}) {
        std::string changed = whole;
        changed[at] = value;
        const std::string code = code_of(changed, limits);
        EXPECT_TRUE(code.empty() || code == "broken-image" || code == "image-too-large" ||
                    code == "unsupported-image")
            << at << ": " << found_;
      }
    }
  }
}

}  // namespace
}  // namespace nacre
