#include "examples/render/image_io.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/support/temporary_folder.h"

namespace nacre::host {
namespace {

Film gradient() {
  Film film(7, 5);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 7; ++x)
      film.mean(x, y) = {0.1f * static_cast<float>(x), 0.3f * static_cast<float>(y), 1234.5678f};
  }
  return film;
}

std::vector<float> read_back(const std::string& path, int channels = 3) {
  const auto in = OIIO::ImageInput::open(path);
  if (!in) return {};
  std::vector<float> v(static_cast<std::size_t>(in->spec().width * in->spec().height * channels));
  in->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, v.data());
  return v;
}

std::string bytes(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(WriteImage, ExrKeepsEveryBit) {
  const TemporaryFolder folder;
  const Film film = gradient();
  Diagnostics diagnostics;
  ASSERT_TRUE(write_image(film, folder.file("a.exr"), {}, diagnostics)) << diagnostics.to_string();
  const std::vector<float> v = read_back(folder.file("a.exr"));
  ASSERT_EQ(v.size(), 105u);
  for (std::size_t i = 0; i < 35; ++i) {
    EXPECT_EQ(v[3 * i], film.pixels()[i].x);
    EXPECT_EQ(v[3 * i + 1], film.pixels()[i].y);
    EXPECT_EQ(v[3 * i + 2], film.pixels()[i].z);
  }
}

TEST(WriteImage, HalfRoundsToHalf) {
  const TemporaryFolder folder;
  Diagnostics diagnostics;
  WriteOptions options;
  options.half = true;
  ASSERT_TRUE(write_image(gradient(), folder.file("a.exr"), options, diagnostics));
  // Halves of 1024 to 2048 are one apart.
  EXPECT_EQ(read_back(folder.file("a.exr"))[2], 1235.f);
  EXPECT_TRUE(diagnostics.all().empty());
}

TEST(WriteImage, WhatHalfCannotHoldIsSaid) {
  const TemporaryFolder folder;
  Film film = gradient();
  film.mean(2, 1).y = 65504.f;
  film.mean(3, 1).y = 1e6f;
  film.mean(4, 1).y = INFINITY;
  Diagnostics diagnostics;
  ASSERT_TRUE(write_image(film, folder.file("a.exr"), {}, diagnostics));
  ASSERT_TRUE(write_image(film, folder.file("a.png"), {.half = true}, diagnostics));
  EXPECT_TRUE(diagnostics.all().empty()) << diagnostics.to_string();
  ASSERT_TRUE(write_image(film, folder.file("a.exr"), {.half = true}, diagnostics));
  const std::vector<float> v = read_back(folder.file("a.exr"));
  EXPECT_EQ(v[3 * (7 + 3) + 1], 65504.f);
  EXPECT_EQ(v[3 * (7 + 4) + 1], INFINITY);
  ASSERT_EQ(diagnostics.all().size(), 1u);
  EXPECT_EQ(diagnostics.all()[0].severity, Severity::warning);
  EXPECT_EQ(diagnostics.all()[0].where.file, folder.file("a.exr"));
  EXPECT_EQ(diagnostics.all()[0].where.path, "G");
  EXPECT_EQ(diagnostics.all()[0].found, "0 to 1000000, 1 of 35 pixels outside");
}

TEST(WriteImage, PngIsToneMappedSrgb) {
  const TemporaryFolder folder;
  Film film(3, 1);
  film.mean(0, 0) = {4.f, 4.f, 4.f};  // the white point
  film.mean(1, 0) = {1.f, 1.f, 1.f};  // (1 + 1/16) / 2 = 0.53125, sRGB 0.7556 = 192.7 / 255
  film.mean(2, 0) = {NAN, 0.f, 0.f};
  Diagnostics diagnostics;
  ASSERT_TRUE(write_image(film, folder.file("a.png"), {}, diagnostics));
  const std::vector<float> v = read_back(folder.file("a.png"));
  EXPECT_EQ(v[0], 1.f);
  EXPECT_EQ(std::lround(255 * v[3]), 193);
  EXPECT_EQ(v[6], 0.f);
}

// Alpha 128 / 255 in 8 bits; sRGB of 0.5 is 0.73536 (IEC 61966-2-1), 187.5 / 255.
TEST(WriteImage, AlphaIsAFourthChannel) {
  const TemporaryFolder folder;
  Film film(2, 1, true);
  film.mean(0, 0) = {0.25f, 0.125f, 0.f};
  film.set_alpha(0, 0, 0.5f);
  film.set_alpha(1, 0, 0.f);
  Diagnostics diagnostics;
  ASSERT_TRUE(write_image(film, folder.file("a.exr"), {}, diagnostics));
  EXPECT_EQ(read_back(folder.file("a.exr"), 4),
            (std::vector<float>{0.25f, 0.125f, 0.f, 0.5f, 0.f, 0.f, 0.f, 0.f}));
  ASSERT_TRUE(write_image(film, folder.file("a.png"), {.white = 0.f}, diagnostics));
  OIIO::ImageSpec as_stored;
  as_stored.attribute("oiio:UnassociatedAlpha", 1);
  const auto in = OIIO::ImageInput::open(folder.file("a.png"), &as_stored);
  ASSERT_NE(in, nullptr);
  std::vector<std::uint8_t> v(8);
  ASSERT_TRUE(in->read_image(0, 0, 0, 4, OIIO::TypeDesc::UINT8, v.data()));
  EXPECT_EQ(v, (std::vector<std::uint8_t>{188, 137, 0, 128, 0, 0, 0, 0}));
}

TEST(WriteImage, SameImageSameBytesAndNothingLeftBehind) {
  const TemporaryFolder folder;
  Diagnostics diagnostics;
  for (const char* name : {"a.exr", "b.exr", "a.png", "b.png"}) {
    ASSERT_TRUE(write_image(gradient(), folder.file(name), {}, diagnostics));
  }
  EXPECT_EQ(bytes(folder.file("a.exr")), bytes(folder.file("b.exr")));
  EXPECT_EQ(bytes(folder.file("a.png")), bytes(folder.file("b.png")));
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    files += entry.is_regular_file();
  }
  EXPECT_EQ(files, 4);
}

TEST(WriteImage, FailureIsADiagnosticAndLeavesNothing) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.file("taken.exr"));
  Diagnostics diagnostics;
  EXPECT_FALSE(write_image(gradient(), folder.file("none/a.exr"), {}, diagnostics));
  EXPECT_FALSE(write_image(gradient(), folder.file("taken.exr"), {}, diagnostics));
  EXPECT_FALSE(write_image(gradient(), folder.file("a.bmp"), {}, diagnostics));
  EXPECT_EQ(diagnostics.error_count(), 3u);
  int entries = 0;
  for ([[maybe_unused]] const auto& e : std::filesystem::directory_iterator(folder.path())) {
    ++entries;
  }
  EXPECT_EQ(entries, 1);
}

}  // namespace
}  // namespace nacre::host
