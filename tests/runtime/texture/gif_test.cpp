// The first image of a GIF, and what is wrong with some.
#include <chrono>

#include "runtime/texture/texture_store.h"
#include "tests/runtime/texture/bytes_as_image.h"
#include "tests/runtime/texture/hostile_image.h"

namespace nacre {
namespace {

using Pixels = std::vector<int>;

class Gif : public BytesAsImage {};

// Four colours; black, red, green, blue.
const std::string table("\0\0\0\xff\0\0\0\xff\0\0\0\xff", 12);
const std::string end(";");
const GifFrame two{.width = 2};

Pixels colors(std::initializer_list<int> numbers) {
  const int rgba[5][4] = {{0, 0, 0, 255}, {255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {}};
  Pixels all;
  for (const int each : numbers) all.insert(all.end(), rgba[each], rgba[each] + 4);
  return all;
}

TEST_F(Gif, ColorsAreOfItsOwnTableOrOfTheFiles) {
  const std::string pixels("\1\2");
  EXPECT_EQ(pixels_of(gif_start(2, 1, table) + gif_frame(two, pixels) + end), colors({1, 2}));
  EXPECT_EQ(channels_, 4);
  GifFrame own = two;
  own.table = std::string("\1\2\3\4\5\6", 6);
  const Pixels expected{4, 5, 6, 255, 1, 2, 3, 255};
  const std::string other("\1\0", 2);
  EXPECT_EQ(pixels_of(gif_start(2, 1, table) + gif_frame(own, other) + end), expected);
  EXPECT_EQ(pixels_of(gif_start(2, 1) + gif_frame(own, other) + end), expected);
  std::string old = gif_start(2, 1, table) + gif_frame(two, pixels) + end;
  old[4] = '7';
  EXPECT_EQ(pixels_of(old), colors({1, 2}));
  EXPECT_EQ(code_of(gif_start(2, 1) + gif_frame(two, pixels) + end), "broken-image");
}

TEST_F(Gif, ColorsThatAreNotInTheTableAreBlack) {
  EXPECT_EQ(pixels_of(gif_start(2, 1, table) + gif_frame(two, "\xff\1") + end), colors({0, 1}));
  GifFrame own = two;
  own.table = std::string("\1\2\3\4\5\6", 6);
  EXPECT_EQ(pixels_of(gif_start(2, 1, table) + gif_frame(own, "\2\xff") + end), colors({0, 0}));
}

TEST_F(Gif, OneColorMayBeTransparentAndSoIsWhatTheImageDoesNotCover) {
  const std::string start = gif_start(2, 1, table), image = gif_frame(two, "\1\2") + end;
  EXPECT_EQ(pixels_of(start + gif_transparency(2) + image), colors({1, 4}));
  EXPECT_EQ(pixels_of(start + gif_transparency(1) + gif_transparency(2) + image), colors({1, 4}));
  std::string without = gif_transparency(2);
  without[3] = 0;
  EXPECT_EQ(pixels_of(start + without + image), colors({1, 2}));
  // It was a text's.
  const std::string text(
      "\x21\x01\x01"
      "a\0",
      5);
  EXPECT_EQ(pixels_of(start + gif_transparency(2) + text + image), colors({1, 2}));
  const GifFrame inside{.left = 1, .top = 1, .width = 2};
  EXPECT_EQ(pixels_of(gif_start(4, 3, table) + gif_frame(inside, "\1\2") + end),
            colors({4, 4, 4, 4, 4, 1, 2, 4, 4, 4, 4, 4}));
}

TEST_F(Gif, RowsMayBeInterlaced) {
  for (int height = 1; height <= 33; ++height) {
    const GifFrame frame{.height = height, .is_interlaced = true};
    std::string greys(768, '\0');
    for (std::size_t i = 0; i < greys.size(); ++i) greys[i] = static_cast<char>(i / 3);
    // GIF89a, appendix E.
    std::string pixels;
    for (const auto& [first, step] : {std::pair{0, 8}, {4, 8}, {2, 4}, {1, 2}}) {
      for (int y = first; y < height; y += step) pixels += static_cast<char>(y);
    }
    Pixels expected;
    for (int y = 0; y < height; ++y) expected.insert(expected.end(), {y, y, y, 255});
    EXPECT_EQ(pixels_of(gif_start(1, height, greys) + gif_frame(frame, pixels) + end), expected);
  }
}

TEST_F(Gif, CodesOfEverySize) {
  for (int size = 0; size <= 9; ++size) {
    const GifFrame frame{.width = 2, .code_size = size};
    const std::string whole = gif_start(2, 1, table) + gif_frame(frame, {"\1\0", 2}) + end;
    const bool is_right = size >= 2 && size <= 8;
    EXPECT_EQ(code_of(whole), is_right ? "" : "broken-image") << size;
    EXPECT_EQ(pixels_, is_right ? colors({1, 0}) : Pixels()) << size;
  }
}

TEST_F(Gif, WhatIsNoFirstImageIsNotLookedAt) {
  const std::string start = gif_start(2, 1, table), image = gif_frame(two, "\1\2");
  const std::string comment("\x21\xfe\x05hello\x02hi\0", 12);
  const std::string loop("\x21\xff\x0bNETSCAPE2.0\x03\x01\0\0\0", 19);
  const std::string second = gif_transparency(1) + gif_frame(two, "\3\3");
  EXPECT_EQ(pixels_of(start + comment + loop + image + comment + second + end), colors({1, 2}));
  EXPECT_EQ(pixels_of(start + image + "anything"), colors({1, 2}));
  EXPECT_EQ(pixels_of(start + image), colors({1, 2}));
}

TEST_F(Gif, TheFirstImageIsTheOnlyLayer) {
  const std::string image = gif_frame(two, "\1\2"), other = gif_frame(two, "\3\3");
  const std::string whole = gif_start(2, 1, table) + image + other + end;
  EXPECT_EQ(code_of(whole, {}, {}, "0"), "");
  EXPECT_EQ(pixels_, colors({1, 2}));
  for (const std::string layer : {"1", "2", "1000", "name"}) {
    EXPECT_EQ(code_of(whole, {}, {}, layer), "unknown-image-layer") << layer;
  }
  EXPECT_EQ(code_of(bmp({}, "abcd"), {}, {}, "1"), "unknown-image-layer");
}

TEST_F(Gif, LargeScreensAreRefusedBeforeTheyAreAllocated) {
  const auto start = std::chrono::steady_clock::now();
  const std::string image = gif_frame({}, "\1") + end;
  EXPECT_EQ(code_of(gif_start(65535, 65535, table) + image), "image-too-large");
  EXPECT_EQ(code_of(gif_start(1, 16385, table) + image), "image-too-large");
  EXPECT_EQ(code_of(gif_start(0, 1, table) + image), "image-too-large");
  EXPECT_EQ(code_of(gif_start(16384, 16384, table) + image), "broken-image");
  EXPECT_NE(found_.find("promises more"), std::string::npos) << found_;
  const std::string comments = "\x21\xfe" + std::string(200'000, '\1') + std::string(1, '\0');
  EXPECT_EQ(code_of(gif_start(16384, 16384, table) + comments + image), "image-too-large")
      << found_;
  // More than an int counts, whatever the limits are.
  ImageLimits limits;
  limits.max_size = 65535;
  limits.max_bytes = std::uint64_t{1} << 40;
  limits.max_expansion = std::uint64_t{1} << 40;
  EXPECT_EQ(code_of(gif_start(65535, 65535, table) + comments + image, limits), "image-too-large");
  EXPECT_EQ(code_of(gif_start(32768, 16384, table) + comments + image, limits), "image-too-large");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
}

TEST_F(Gif, WrongOnesAreBroken) {
  const std::string start = gif_start(2, 1, table), image = gif_frame(two, "\1\2") + end;
  const auto broken = [&](const std::string& bytes, const std::string& reason) {
    EXPECT_EQ(code_of(bytes), "broken-image") << reason;
    EXPECT_NE(found_.find(reason), std::string::npos) << found_;
  };
  broken(start + end, "no image");
  broken(start + "x" + image, "no known kind");
  broken(start + std::string("\x21\xf9\x03\1\0\0\0", 7) + image, "wrong length");
  broken(start + std::string("\x21\xf9\x04\1\0\0\1\x01\1\0", 10) + image, "wrong length");
  broken(start + std::string("\x21\xf9\0", 3) + image, "wrong length");
  for (const GifFrame& frame : {GifFrame{.left = 1, .width = 2},
                                {.top = 1},
                                {.left = 65535},
                                {.width = 65535},
                                {.height = 2},
                                {.width = 0},
                                {.height = 0}}) {
    broken(start + gif_frame(frame, "\1\2") + end, "not inside");
  }
  std::string idle = start + gif_frame(two, "\1\2");
  idle.pop_back();
  for (int i = 0; i < 300; ++i) idle += "\xff" + std::string(255, '\0');
  broken(idle + std::string(1, '\0') + end, "more data");
  EXPECT_EQ(code_of(start + gif_frame(two, "\1") + end), "broken-image");  // A pixel too few.
  EXPECT_EQ(code_of(start + gif_frame(two, "") + end), "broken-image");
}

TEST_F(Gif, CutBeforeTheImageEndsItIsBroken) {
  GifFrame own = two;
  own.table = table;
  for (const std::string& whole :
       {gif_start(2, 1, table) + gif_transparency(1) + gif_frame(two, "\1\2"),
        gif_start(2, 1) + std::string("\x21\xfe\2hi\0", 6) + gif_frame(own, "\1\2")}) {
    ASSERT_EQ(code_of(whole), "") << found_;
    for (std::size_t size = 1; size < whole.size(); ++size) {
      EXPECT_EQ(code_of(whole.substr(0, size)), size < 6 ? "unsupported-image" : "broken-image")
          << size;
    }
  }
}

/// Sanitizers look.
TEST_F(Gif, AnyByteMayBeAnything) {
  const GifFrame frame{
      .width = 3, .height = 2, .is_interlaced = true, .code_size = 2, .table = table.substr(6)};
  const std::string whole = gif_start(4, 3, table) + gif_transparency(1) +
                            gif_frame(frame, {"\0\1\1\0\0\1", 6}) + gif_frame(two, "\1\2") + end;
  ASSERT_EQ(code_of(whole), "") << found_;
  ImageLimits limits;
  limits.max_size = 128;
  for (std::size_t at = 6; at < whole.size(); ++at) {
    for (const char value : {'\0', '\1', '\2', '\x21', '\x7f', '\xff'}) {
      std::string changed = whole;
      changed[at] = value;
      const std::string code = code_of(changed, limits);
      EXPECT_TRUE(code.empty() || code == "broken-image" || code == "image-too-large")
          << at << ": " << found_;
    }
  }
}

}  // namespace
}  // namespace nacre
