// How a picture goes to a denoiser and comes back; and what the real one makes of noise, where
// there is one (NACRE_OPENIMAGEDENOISE).
#include "examples/render/denoise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

namespace nacre::host {
namespace {

/// With passes "albedo" and "normal"; a smooth image with noise of that deviation.
Film picture(int width, int height, float deviation) {
  Film film(width, height);
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0.f, deviation);
  const auto pixels = static_cast<std::size_t>(width * height);
  for (const char* const channel :
       {"albedo.R", "albedo.G", "albedo.B", "normal.X", "normal.Y", "normal.Z"}) {
    film.passes.channels.emplace_back(channel);
    film.passes.planes.emplace_back(pixels, film.passes.channels.size() <= 3 ? 0.25f : 0.5f);
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float light = 1.f + 0.5f * static_cast<float>(x) / static_cast<float>(width);
      film.mean(x, y) = {light + noise(random), light + noise(random),
                         0.5f * light + noise(random)};
    }
  }
  return film;
}

std::vector<float> plane(const Film& film, const std::string& channel) {
  const auto found = std::ranges::find(film.passes.channels, channel);
  if (found == film.passes.channels.end()) return {};
  return film.passes.planes[static_cast<std::size_t>(found - film.passes.channels.begin())];
}

double error(const Film& film) {
  const Film right = picture(film.width(), film.height(), 0.f);
  double sum = 0.0;
  for (std::size_t i = 0; i < film.pixels().size(); ++i) {
    const Vec3 off = film.pixels()[i] - right.pixels()[i];
    sum += double{dot(off, off)};
  }
  return sum / static_cast<double>(film.pixels().size());
}

TEST(Denoiser, GetsThePictureAndWhatGuidesIt) {
  Diagnostics diagnostics;
  const auto denoiser = Denoiser::load(NACRE_DENOISE_MOCK, 2, diagnostics);
  ASSERT_NE(denoiser, nullptr) << diagnostics.to_string();
  EXPECT_EQ(denoiser->name(), "Open Image Denoise 2.3.4");
  Film film = picture(5, 3, 0.1f);
  const Film before = film;
  ASSERT_TRUE(denoiser->denoise(film, diagnostics)) << diagnostics.to_string();
  EXPECT_EQ(film.denoised_by, denoiser->name());
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 5; ++x) {
      // What the mock computes of the column at the other end.
      EXPECT_FLOAT_EQ(film.mean(x, y).y, 0.5f * before.mean(4 - x, y).y + 0.25f + 5.f);
      EXPECT_EQ(plane(film, "noisy.G")[film.index(x, y)], before.mean(x, y).y);
    }
  }
}

TEST(Denoiser, DoesWithoutGuides) {
  Diagnostics diagnostics;
  const auto denoiser = Denoiser::load(NACRE_DENOISE_MOCK, 0, diagnostics);
  ASSERT_NE(denoiser, nullptr);
  Film film(4, 1);
  film.mean(0, 0) = {1.f, 2.f, 4.f};
  ASSERT_TRUE(denoiser->denoise(film, diagnostics));
  EXPECT_EQ(film.mean(3, 0).z, 2.f);
}

TEST(Denoiser, SaysWhatWentWrong) {
  Diagnostics diagnostics;
  const auto denoiser = Denoiser::load(NACRE_DENOISE_MOCK, 0, diagnostics);
  ASSERT_NE(denoiser, nullptr);
  Film film(2, 2);
  film.mean(0, 0) = {-1.f, 0.f, 0.f};
  EXPECT_FALSE(denoiser->denoise(film, diagnostics));
  ASSERT_EQ(diagnostics.all().size(), 1u);
  EXPECT_EQ(diagnostics.all()[0].found, "made to fail");
  EXPECT_EQ(film.denoised_by, "");
  EXPECT_EQ(film.mean(0, 0).x, -1.f);
}

TEST(Denoiser, IsNoOtherLibrary) {
  for (const char* const file : {"/nowhere/libOpenImageDenoise.so", "libm.so.6"}) {
    Diagnostics diagnostics;
    EXPECT_EQ(Denoiser::load(file, 0, diagnostics), nullptr) << file;
    ASSERT_EQ(diagnostics.all().size(), 1u) << file;
    EXPECT_EQ(diagnostics.all()[0].code, "no-denoiser");
  }
}

TEST(Denoiser, TheRealOneTakesNoiseAway) {
  const char* const library = std::getenv("NACRE_OPENIMAGEDENOISE");
  if (library == nullptr) GTEST_SKIP() << "NACRE_OPENIMAGEDENOISE names no library";
  Diagnostics diagnostics;
  const auto denoiser = Denoiser::load(library, 1, diagnostics);
  ASSERT_NE(denoiser, nullptr) << diagnostics.to_string();
  Film film = picture(96, 64, 0.3f);
  const double before = error(film);
  ASSERT_TRUE(denoiser->denoise(film, diagnostics)) << diagnostics.to_string();
  EXPECT_LT(error(film), 0.1 * before);
}

}  // namespace
}  // namespace nacre::host
