#include "examples/render/environment.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace nacre::host {
namespace {

constexpr double pi = std::numbers::pi;

Environment spotty(int width, int height, float rotation,
                   Environment::Drawn drawn = Environment::Drawn::all) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> value(0.f, 1.f);
  std::vector<Vec3> texels;
  for (int i = 0; i < width * height; ++i) {
    const bool black = value(random) < 0.7f;
    texels.push_back(black ? Vec3{} : Vec3{value(random), 30.f * value(random), value(random)});
  }
  return {width, height, texels, rotation, drawn};
}

Vec3 direction(double z_from_top, double azimuth) {
  const double y = 1 - 2 * z_from_top, r = std::sqrt(std::max(0.0, 1 - y * y));
  return {static_cast<float>(r * std::sin(azimuth)), static_cast<float>(y),
          static_cast<float>(-r * std::cos(azimuth))};
}

TEST(Environment, DensityIntegratesToOne) {
  for (const Environment& e : {spotty(16, 8, 0.3f), spotty(5, 3, -2.f), Environment::studio(),
                               Environment::constant({2.f, 2.f, 2.f})}) {
    constexpr int n = 1500;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j)
        sum += e.light(direction((i + 0.5) / n, 2 * pi * (j + 0.5) / n)).pdf;
    }
    EXPECT_NEAR(sum * 4 * pi / (double{n} * n), 1, 2e-3);
  }
}

TEST(Environment, DensityAboveTheMeanIntegratesToOneAndIsInProportion) {
  constexpr int width = 16, height = 8;
  const Environment e = spotty(width, height, 0.f, Environment::Drawn::above_mean);
  const Environment all = spotty(width, height, 0.f);
  EXPECT_EQ(e.mean_luminance(), all.mean_luminance());
  double sum = 0, scale = 0;
  for (int y = 0; y < height; ++y) {
    const double solid =
        2 * pi / width * (std::cos(pi * y / height) - std::cos(pi * (y + 1) / height));
    for (int x = 0; x < width; ++x) {
      const Vec3 middle = direction(0.5 - 0.5 * std::cos(pi * (y + 0.5) / height),
                                    2 * pi * ((x + 0.5) / width - 0.5));
      const double pdf = e.light(middle).pdf;  // The same all over a texel.
      sum += pdf * solid;
      // What all of it is drawn by is its luminance over 4 pi times the mean.
      const double excess = 4 * pi * all.light(middle).pdf - 1;
      if (excess > 0 && scale == 0) scale = pdf / excess;
      EXPECT_NEAR(pdf, excess > 0 ? scale * excess : 0, 1e-4) << x << ' ' << y;
    }
  }
  EXPECT_NEAR(sum, 1, 1e-5);
}

// Means of texels that are alike differ by rounding: nothing is to be drawn by that.
TEST(Environment, EvenOnesAreDrawnWhole) {
  for (const int width : {1, 16, 64}) {
    const std::vector<Vec3> texels(static_cast<std::size_t>(width * width), {0.3f, 0.7f, 1.1f});
    const Environment even(width, width, texels, 0.f, Environment::Drawn::above_mean);
    for (int i = 0; i < 200; ++i) {
      const float pdf = even.light(direction((i + 0.5) / 200, 0.7 * i)).pdf;
      EXPECT_NEAR(pdf, 1 / (4 * pi), 1e-5) << width;
    }
  }
  const Environment black(1, 1, {{}}, 0.f, Environment::Drawn::above_mean);
  EXPECT_EQ(black.sample({0.3f, 0.4f}).pdf, 0.f);
}

TEST(Environment, StudioIsScaledAndTurned) {
  const Environment studio = Environment::studio();
  const Environment turned = Environment::studio(2.f, 0.5f);
  for (int i = 0; i < 100; ++i) {
    const double z = 0.01 * i + 0.005, azimuth = 0.37 * i;
    const Vec3 was = studio.light(direction(z, azimuth)).radiance;
    const Vec3 is = turned.light(direction(z, azimuth + 0.5)).radiance;
    EXPECT_NEAR(is.x, 2.f * was.x, 1e-3f * (1.f + was.x));
    EXPECT_NEAR(is.z, 2.f * was.z, 1e-3f * (1.f + was.z));
  }
  EXPECT_EQ(Environment::studio(0.f).mean_luminance(), 0.f);
}

TEST(Environment, SamplesFollowTheDensity) {
  const int width = 16, height = 8, n = 200000;
  const Environment e = spotty(width, height, 0.f);
  std::vector<double> counts(static_cast<std::size_t>(width * height));
  std::vector<double> expected(counts.size());
  std::mt19937 random(11);
  std::uniform_real_distribution<float> u(0.f, 1.f);
  for (int i = 0; i < n; ++i) {
    const Environment::Sample s = e.sample({u(random), u(random)});
    ASSERT_GT(s.pdf, 0.f);
    ASSERT_NEAR(dot(s.wi, s.wi), 1.f, 1e-5f);
    const double x = (std::atan2(s.wi.x, -s.wi.z) / (2 * pi) + 0.5) * width;
    const double y = (0.5 - std::asin(s.wi.y) / pi) * height;
    counts[static_cast<std::size_t>(std::min<int>(static_cast<int>(y), height - 1) * width +
                                    std::min<int>(static_cast<int>(x), width - 1))] += 1;
  }
  double chi = 0;
  int cells = 0;
  for (int y = 0; y < height; ++y) {
    const double solid =
        2 * pi / width * (std::cos(pi * y / height) - std::cos(pi * (y + 1) / height));
    for (int x = 0; x < width; ++x) {
      const double azimuth = 2 * pi * ((x + 0.5) / width - 0.5);
      const Vec3 centre = direction(0.5 - 0.5 * std::cos(pi * (y + 0.5) / height), azimuth);
      const double want = n * e.light(centre).pdf * solid;
      const double got = counts[static_cast<std::size_t>(y * width + x)];
      if (want < 5) {
        EXPECT_LT(got, 30);
        continue;
      }
      chi += (got - want) * (got - want) / want;
      ++cells;
    }
  }
  // 99.99 % quantile of chi² by Wilson and Hilferty 1931, z = 3.719.
  const double k = cells - 1, h = 2 / (9 * k);
  EXPECT_LT(chi, k * std::pow(1 - h + 3.719 * std::sqrt(h), 3));
}

TEST(Environment, SampleAgreesWithRadianceAndDensity) {
  const Environment e = spotty(16, 8, 1.1f);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> u(0.f, 1.f);
  int differ = 0;
  for (int i = 0; i < 10000; ++i) {
    const Environment::Sample s = e.sample({u(random), u(random)});
    const Vec3 l = e.light(s.wi).radiance;
    // The sample knows its place in the image; that of the direction is as exact as angles are.
    EXPECT_NEAR(l.y, s.radiance.y, 1e-4f * (1.f + l.y));
    // Rounding may carry a direction over the edge of its texel, seldom.
    differ += std::abs(e.light(s.wi).pdf - s.pdf) > 1e-4f * s.pdf;
  }
  EXPECT_LE(differ, 10);
}

TEST(Environment, NoLightWhereTheDensityIsZero) {
  std::vector<Vec3> texels(64 * 32);
  texels[10 * 64 + 20] = {1.f, 1.f, 1.f};
  const Environment e(64, 32, std::move(texels));
  for (int i = 0; i < 400; ++i) {
    for (int j = 0; j < 400; ++j) {
      const Vec3 d = direction((i + 0.5) / 400, 2 * pi * (j + 0.5) / 400);
      if (luminance(e.light(d).radiance) > 1e-6f) {
        ASSERT_GT(e.light(d).pdf, 0.f);
      }
    }
  }
}

TEST(Environment, TopRowIsUpAndTheMiddleIsMinusZ) {
  std::vector<Vec3> texels(8 * 4);
  for (int x = 0; x < 8; ++x) texels[static_cast<std::size_t>(x)] = {1.f, 0.f, 0.f};
  for (int y = 1; y < 3; ++y) {
    for (int x = 3; x < 5; ++x) texels[static_cast<std::size_t>(y * 8 + x)] = {0.f, 1.f, 0.f};
    for (int x = 5; x < 7; ++x) texels[static_cast<std::size_t>(y * 8 + x)] = {0.f, 0.f, 1.f};
  }
  const Environment e(8, 4, texels);
  EXPECT_EQ(e.light({0.f, 1.f, 0.f}).radiance.x, 1.f);
  EXPECT_EQ(e.light({0.f, 0.f, -1.f}).radiance.y, 1.f);
  EXPECT_EQ(e.light({1.f, 0.f, 0.f}).radiance.z, 1.f);
  EXPECT_EQ(e.light({-1.f, 0.f, 0.f}).radiance.z, 0.f);
}

// Whole waves are asked at once: the place within a block changes nothing.
TEST(Environment, ManyAreTheSameAsOneByOne) {
  const Environment e = spotty(64, 32, 0.7f);
  std::mt19937 random(11);
  std::uniform_real_distribution<float> u(0.f, 1.f);
  for (const std::size_t count : {1u, 8u, 63u, 64u, 65u, 300u}) {
    std::vector<Uniform2> numbers;
    for (std::size_t i = 0; i < count; ++i) numbers.push_back({u(random), u(random)});
    std::vector<Environment::Sample> samples(count);
    e.sample(numbers, samples);
    std::vector<Vec3> directions;
    for (const Environment::Sample& s : samples) directions.push_back(s.wi);
    std::vector<Environment::Light> lights(count);
    e.light(directions, lights);
    for (std::size_t i = 0; i < count; ++i) {
      const Environment::Sample s = e.sample(numbers[i]);
      ASSERT_EQ(s.wi.x, samples[i].wi.x) << i << " of " << count;
      ASSERT_EQ(s.radiance.y, samples[i].radiance.y) << i << " of " << count;
      ASSERT_EQ(s.pdf, samples[i].pdf) << i << " of " << count;
      const Environment::Light l = e.light(directions[i]);
      ASSERT_EQ(l.radiance.x, lights[i].radiance.x) << i << " of " << count;
      ASSERT_EQ(l.pdf, lights[i].pdf) << i << " of " << count;
    }
  }
}

// Directions have length 1, at any rotation: the sine and cosine of an angle belong together.
TEST(Environment, DirectionsAreUnitVectors) {
  for (const float rotation : {0.f, 1.f, -2.f, 40.f}) {
    const Environment e = spotty(32, 16, rotation);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> u(0.f, 1.f);
    for (int i = 0; i < 20000; ++i) {
      const Vec3 wi = e.sample({u(random), u(random)}).wi;
      ASSERT_NEAR(double{wi.x} * wi.x + double{wi.y} * wi.y + double{wi.z} * wi.z, 1.0, 1e-6);
    }
  }
}

// Against the library's inverse functions, in double.
TEST(Environment, DirectionsAreWhereTheImageHasThem) {
  const int width = 512, height = 256;
  std::vector<Vec3> texels;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) texels.push_back({float(x), float(y), 0.f});
  }
  const Environment e(width, height, texels);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 d = direction(std::fmod(0.5 + i * 0.7548776662, 1.0), i * 3.5787089);
    const double x = (0.5 + std::atan2(double{d.x}, -double{d.z}) / (2 * pi)) * width - 0.5;
    const double y = (0.5 - std::asin(double{d.y}) / pi) * height - 0.5;
    const Vec3 found = e.light(d).radiance;
    if (x > 0 && x < width - 1) {
      EXPECT_NEAR(found.x, x, 2e-3);
    }
    EXPECT_NEAR(found.y, std::clamp(y, 0.0, height - 1.0), 2e-3);
  }
}

TEST(Environment, BlackGivesNoSample) {
  EXPECT_EQ(Environment::constant({}).sample({0.3f, 0.4f}).pdf, 0.f);
  const float nan = std::nanf("");
  EXPECT_EQ(Environment::constant({nan, -1.f, INFINITY}).mean_luminance(), 0.f);
}

TEST(Environment, MissingFileIsADiagnostic) {
  Diagnostics diagnostics;
  EXPECT_FALSE(Environment::load("/nonexistent/sky.hdr", 1.f, 0.f, {}, diagnostics));
  EXPECT_EQ(diagnostics.error_count(), 1u);
}

/// A file of every format that has some pixels, cut at many places: an environment, or one
/// error that names it, and never a file that is cut inside its pixels.
TEST(Environment, CutFilesAreErrors) {
  const TemporaryFolder folder;
  const std::vector<float> samples(16 * 8 * 3, 0.25f);
  for (const char* name : {"a.exr", "a.png", "a.jpg", "a.tif", "a.hdr", "a.tga"}) {
    const std::string path = folder.file(name);
    const auto out = OIIO::ImageOutput::create(path);
    OIIO::ImageSpec spec(16, 8, 3, OIIO::TypeDesc::UINT8);
    if (name[2] == 'e' || name[2] == 'h') spec.format = OIIO::TypeDesc::FLOAT;
    ASSERT_TRUE(out && out->open(path, spec) &&
                out->write_image(OIIO::TypeDesc::FLOAT, samples.data()) && out->close());
    std::ifstream stream(path, std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(stream), {}};
    Diagnostics none;
    ASSERT_TRUE(Environment::load(path, 1.f, 0.f, {}, none)) << none.to_string();
    for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 40) {
      Diagnostics diagnostics;
      const std::string cut = folder.write("cut", whole.substr(0, size));
      const auto environment = Environment::load(cut, 1.f, 0.f, {}, diagnostics);
      EXPECT_EQ(environment.has_value(), !diagnostics.has_errors()) << name << ' ' << size;
      EXPECT_LE(diagnostics.error_count(), 1u) << diagnostics.to_string();
      if (size < whole.size() / 3) {
        EXPECT_FALSE(environment.has_value()) << name << size;
      }
    }
  }
}

TEST(Environment, WhatIsNoRadianceIsSaid) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.exr");
  const auto out = OIIO::ImageOutput::create(path);
  const std::vector<float> samples{1, 1, 1, -1, 1, 1, 1, NAN, 1, 1, 1, INFINITY};
  ASSERT_TRUE(out && out->open(path, OIIO::ImageSpec(2, 2, 3, OIIO::TypeDesc::FLOAT)) &&
              out->write_image(OIIO::TypeDesc::FLOAT, samples.data()) && out->close());
  Diagnostics diagnostics;
  EXPECT_TRUE(Environment::load(path, 1.f, 0.f, {}, diagnostics));
  ASSERT_EQ(diagnostics.warning_count(), 1u);
  EXPECT_EQ(diagnostics.all()[0].found, "3 such texels");
}

}  // namespace
}  // namespace nacre::host
