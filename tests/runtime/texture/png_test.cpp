// PNG whose checksums are right and whose contents are not: libpng would print about them.
#include <array>

#include "tests/runtime/texture/bytes_as_image.h"
#include "tests/runtime/texture/hostile_image.h"

namespace nacre {
namespace {

class Png : public BytesAsImage {
 protected:
  void SetUp() override { testing::internal::CaptureStderr(); }
  void TearDown() override { EXPECT_EQ(testing::internal::GetCapturedStderr(), ""); }
};

const std::string end = png_chunk("IEND", "");

std::string image(const PngFields& fields, const std::string& rows) {
  return png_start(fields) + png_chunk("IDAT", zlib_stored(rows)) + end;
}

TEST_F(Png, DamagedDataAreBroken) {
  const std::string rows("\0ab\0cd\0ef", 9), stream = zlib_stored(rows);
  const std::string start = png_start({.width = 2, .height = 3});
  ASSERT_EQ(code_of(start + png_chunk("IDAT", stream) + end), "") << found_;
  EXPECT_EQ(pixels_, (std::vector<int>{'a', 'b', 'c', 'd', 'e', 'f'}));
  for (std::size_t at = 0; at < stream.size(); ++at) {
    std::string damaged = stream;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
    EXPECT_EQ(code_of(start + png_chunk("IDAT", damaged) + end), "broken-image") << at;
    EXPECT_EQ(code_of(start + png_chunk("IDAT", stream.substr(0, at)) + end), "broken-image") << at;
    EXPECT_EQ(code_of(start + png_chunk("IDAT", stream.substr(0, at)) + png_chunk("IDAT", "") +
                      png_chunk("IDAT", stream.substr(at)) + end),
              "")
        << at;
  }
  EXPECT_EQ(code_of(start + end), "broken-image");
  EXPECT_EQ(code_of(start + png_chunk("IDAT", "") + end), "broken-image");
}

TEST_F(Png, RowsAreAsManyAsTheHeaderSays) {
  for (const int interlacing : {0, 1}) {
    for (std::uint32_t side = 1; side <= 17; ++side) {
      for (const auto& [depth, color] :
           {std::pair{1, 0}, {4, 0}, {8, 0}, {16, 0}, {8, 2}, {8, 4}, {16, 6}}) {
        const PngFields fields{.width = side,
                               .height = 18 - side,
                               .depth = depth,
                               .color_type = color,
                               .interlacing = interlacing};
        const std::uint32_t bits = static_cast<std::uint32_t>(depth) * (color == 2   ? 3
                                                                        : color == 4 ? 2
                                                                        : color == 6 ? 4
                                                                                     : 1);
        std::size_t expected = 0;
        const std::vector<std::array<std::uint32_t, 4>> grids =
            interlacing == 0 ? std::vector<std::array<std::uint32_t, 4>>{{0, 0, 1, 1}}
                             : std::vector<std::array<std::uint32_t, 4>>{
                                   {0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
                                   {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};
        for (const auto& [x, y, step_x, step_y] : grids) {
          std::size_t columns = 0;
          for (std::uint32_t i = x; i < fields.width; i += step_x) ++columns;
          for (std::uint32_t i = y; i < fields.height && columns > 0; i += step_y) {
            expected += 1 + (columns * bits + 7) / 8;
          }
        }
        EXPECT_EQ(code_of(image(fields, std::string(expected, '\0'))), "") << found_;
        EXPECT_EQ(code_of(image(fields, std::string(expected - 1, '\0'))), "broken-image");
        EXPECT_EQ(code_of(image(fields, std::string(expected + 1, '\0'))), "") << found_;
      }
    }
  }
}

TEST_F(Png, MoreRowsThanTheHeaderSaysAreNotUnpackedForLong) {
  EXPECT_EQ(code_of(image({}, std::string(60'000, '\0'))), "") << found_;
  EXPECT_EQ(code_of(image({}, std::string(1'000'000, '\0'))), "broken-image");
}

TEST_F(Png, FiltersThatThereAreNot) {
  for (int filter = 0; filter < 256; ++filter) {
    std::string rows("\0ab\0cd\0ef", 9);
    rows[3] = static_cast<char>(filter);
    EXPECT_EQ(code_of(image({.width = 2, .height = 3}, rows)), filter <= 4 ? "" : "broken-image");
  }
}

TEST_F(Png, HeadersThatMakeNoSense) {
  const std::string rows(64, '\0');
  for (int depth = 0; depth <= 17; ++depth) {
    for (int color = 0; color <= 7; ++color) {
      const bool is_byte = depth == 8 || depth == 16;
      const bool is_less = depth == 1 || depth == 2 || depth == 4;
      const bool is_right = (color == 0 && (is_byte || is_less)) ||
                            ((color == 2 || color == 4 || color == 6) && is_byte);
      EXPECT_EQ(code_of(image({.depth = depth, .color_type = color}, rows)),
                is_right ? "" : "broken-image")  // 3 lacks its palette.
          << depth << " " << color;
    }
  }
  for (const PngFields& fields :
       {PngFields{.compression = 1}, {.filter = 1}, {.filter = 64}, {.interlacing = 2}}) {
    EXPECT_EQ(code_of(image(fields, rows)), "broken-image");
  }
}

TEST_F(Png, Palettes) {
  const std::string start = png_start({.color_type = 3});
  const std::string data = png_chunk("IDAT", zlib_stored({"\0\1", 2}));
  const std::string palette = png_chunk("PLTE", "abcdef");
  EXPECT_EQ(code_of(start + palette + data + end), "") << found_;
  EXPECT_EQ(pixels_, (std::vector<int>{'d', 'e', 'f'}));
  EXPECT_EQ(code_of(start + palette + png_chunk("tRNS", "A") + data + end), "") << found_;
  EXPECT_EQ(channels_, 4);
  EXPECT_EQ(code_of(start + palette + data + png_chunk("tRNS", "A") + end), "") << found_;
  EXPECT_EQ(channels_, 3);
  for (const std::string& before :
       {std::string(), palette + palette, png_chunk("PLTE", ""), png_chunk("PLTE", "abcd"),
        png_chunk("PLTE", std::string(771, 'a'))}) {
    EXPECT_EQ(code_of(start + before + data + palette + end), "broken-image");
  }
  // Grey images have none; true colours may propose one.
  EXPECT_EQ(code_of(png_start({}) + palette + data + end), "") << found_;
  EXPECT_EQ(code_of(png_start({}) + data + palette + palette + end), "") << found_;
}

}  // namespace
}  // namespace nacre
