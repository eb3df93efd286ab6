#include "tests/runtime/texture/reference_sampler.h"

#include <OpenImageIO/texture.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/runtime/texture/test_image.h"

namespace nacre {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr Rgba64 none{9, 9, 9, 9};

class ReferenceSamplerTest : public testing::Test {
 protected:
  ReferenceSampler write(const TestImage& image) {
    WriteOptions options;
    options.type = "float";
    EXPECT_TRUE(write_image(folder_.file("a.exr"), image, options));
    auto sampler = ReferenceSampler::open(folder_.file("a.exr"));
    EXPECT_TRUE(sampler.has_value());
    return *sampler;
  }
  TemporaryFolder folder_;
};

TestImage ramp(int width, int height) {
  TestImage image = random_image(width, height, 3, 255);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.at(x, y, 0) = static_cast<float>(x) + 0.5f;
      image.at(x, y, 1) = static_cast<float>(y) + 0.5f;
    }
  }
  return image;
}

// Tent and B-spline both reproduce straight lines, in the middle of an image.
TEST_F(ReferenceSamplerTest, LinearAndCubicReproduceARamp) {
  const ReferenceSampler sampler = write(ramp(16, 8));
  for (const auto filter : {TextureFilter::linear, TextureFilter::cubic}) {
    for (double u = 0.2; u < 0.8; u += 0.037) {
      const Rgba64 value = sampler.sample(u, 0.43, {}, {filter}, none);
      EXPECT_NEAR(value[0], 16 * u, 1e-12);
      EXPECT_NEAR(value[1], 8 * 0.43, 1e-12);
      EXPECT_NEAR(value[3], 1, 1e-12);  // No alpha in the file.
    }
  }
}

TEST_F(ReferenceSamplerTest, OriginIsTheLowerLeftTexel) {
  const ReferenceSampler sampler = write(ramp(4, 4));
  const ReferenceModes modes{TextureFilter::closest};
  EXPECT_EQ(sampler.sample(0.01, 0.01, {}, modes, none)[1], 0.5);
  EXPECT_EQ(sampler.sample(0.01, 0.99, {}, modes, none)[1], 3.5);
  EXPECT_EQ(
      sampler.sample(1, 1, {}, {TextureFilter::closest, AddressMode::clamp, AddressMode::clamp},
                     none)[0],
      3.5);
}

TEST_F(ReferenceSamplerTest, CubicSpreadsATexelAsTheBSplineSays) {
  TestImage image = random_image(8, 1, 1, 1);
  for (float& sample : image.samples) sample = 0;
  image.at(4, 0, 0) = 1;
  const ReferenceSampler sampler = write(image);
  const ReferenceModes modes{TextureFilter::cubic};
  const auto at = [&](double texel) {
    return sampler.sample((texel + 0.5) / 8, 0.5, {}, modes, none)[0];
  };
  EXPECT_NEAR(at(4), 2.0 / 3, 1e-14);
  EXPECT_NEAR(at(3), 1.0 / 6, 1e-14);
  EXPECT_NEAR(at(5), 1.0 / 6, 1e-14);
  EXPECT_NEAR(at(3.5), 23.0 / 48, 1e-14);
  EXPECT_NEAR(at(2), 0, 1e-14);
}

TEST_F(ReferenceSamplerTest, AddressModesFollowTheStandard) {
  const ReferenceSampler sampler = write(random_image(6, 5, 4, 1000));
  for (const auto filter : {TextureFilter::closest, TextureFilter::linear, TextureFilter::cubic}) {
    const auto at = [&](double u, double v, AddressMode mode) {
      return sampler.sample(u, v, {}, {filter, mode, mode}, none);
    };
    for (double u = 0.013; u < 1; u += 0.11) {
      const double v = 0.3 + u / 3;
      for (std::size_t c = 0; c < 4; ++c) {
        EXPECT_NEAR(at(u - 3, v + 2, AddressMode::periodic)[c], at(u, v, AddressMode::periodic)[c],
                    1e-12);
        EXPECT_NEAR(at(-u, 2 - v, AddressMode::mirror)[c], at(u, v, AddressMode::mirror)[c], 1e-12);
        EXPECT_NEAR(at(u + 4, v, AddressMode::mirror)[c], at(u, v, AddressMode::mirror)[c], 1e-12);
        EXPECT_EQ(at(-u, v, AddressMode::clamp)[c], at(0, v, AddressMode::clamp)[c]);
        EXPECT_EQ(at(u, v + 1, AddressMode::clamp)[c], at(u, 1, AddressMode::clamp)[c]);
        EXPECT_EQ(at(u, v, AddressMode::constant)[c], at(u, v, AddressMode::clamp)[c]);
      }
      EXPECT_EQ(at(u, 1.001, AddressMode::constant), none);
      EXPECT_EQ(at(-1e-9, v, AddressMode::constant), none);
    }
    EXPECT_EQ(at(nan, 0.5, AddressMode::constant), none);
    EXPECT_EQ(at(nan, 0.5, AddressMode::periodic), at(0, 0.5, AddressMode::periodic));
  }
}

TEST_F(ReferenceSamplerTest, FootprintOfTheWholeImageGivesItsMean) {
  const TestImage image = random_image(16, 16, 1, 255);
  double mean = 0;
  for (const float sample : image.samples) mean += sample / 256.0;
  const ReferenceSampler sampler = write(image);
  EXPECT_NEAR(sampler.sample(0.3, 0.7, {1, 0, 0, 1}, {}, none)[0], mean, 1e-12);
  EXPECT_NEAR(sampler.sample(0.3, 0.7, {0, 50, 50, 0}, {}, none)[0], mean, 1e-12);
}

TEST_F(ReferenceSamplerTest, EllipseHasTheSingularValuesOfTheFootprint) {
  const ReferenceSampler sampler = write(random_image(64, 32, 1, 255));
  const auto along_u = sampler.ellipse({4.0 / 64, 0, 0, 1.0 / 32});
  EXPECT_NEAR(along_u.major, 4, 1e-12);
  EXPECT_NEAR(along_u.minor, 1, 1e-7);
  EXPECT_NEAR(std::sin(along_u.angle), 0, 1e-7);
  const auto line = sampler.ellipse({3.0 / 64, 4.0 / 32, 0, 0});
  EXPECT_NEAR(line.major, 5, 1e-12);
  EXPECT_NEAR(line.minor, 0, 1e-6);
  EXPECT_NEAR(std::tan(line.angle), 4.0 / 3, 1e-6);
  // Sum of squares and product are the trace and determinant of X X^T + Y Y^T.
  const auto skewed = sampler.ellipse({2.0 / 64, 1.0 / 32, -1.0 / 64, 3.0 / 32});
  EXPECT_NEAR(skewed.major * skewed.major + skewed.minor * skewed.minor, 15, 1e-9);
  EXPECT_NEAR(skewed.major * skewed.minor, 7, 1e-6);
  EXPECT_NEAR(sampler.ellipse({1e30, 0, 0, 0}).major, 1024 * 64, 1e-6);
}

// On a square image the two filters are one: OpenImageIO computes the ellipse in uv.
TEST_F(ReferenceSamplerTest, AnisotropicFilterIsOpenImageIos) {
  const ReferenceSampler sampler = write(random_image(64, 64, 3, 255));
  // The shared one: others OpenImageIO 2.4 deletes as what they are not.
  OIIO::TextureSystem* system = OIIO::TextureSystem::create(true);
  system->attribute("automip", 1);
  const OIIO::ustring file(folder_.file("a.exr"));
  std::mt19937 random(11);
  std::uniform_real_distribution<float> any(-1.0f, 1.0f);
  int several = 0;
  for (const int most : {1, 4, 16, 32}) {
    OIIO::TextureOpt options;
    options.swrap = OIIO::TextureOpt::WrapPeriodic;
    options.twrap = OIIO::TextureOpt::WrapMirror;
    options.interpmode = OIIO::TextureOpt::InterpBilinear;
    options.anisotropic = most;
    for (int i = 0; i < 500; ++i) {
      const float u = any(random);
      const float v = any(random);
      const float size = std::exp2(5 * any(random) - 4);
      const float flat = std::exp2(-2.5f + 2.5f * any(random));
      const float turn = 4 * any(random);
      const float dudx = size * std::cos(turn);
      const float dvdx = size * std::sin(turn);
      const float dudy = -flat * dvdx + 0.1f * dudx;
      const float dvdy = flat * dudx + 0.1f * dvdx;
      std::array<float, 3> theirs{};
      ASSERT_TRUE(
          system->texture(file, options, u, 1 - v, dudx, -dvdx, dudy, -dvdy, 3, theirs.data()));
      const ReferenceModes modes{TextureFilter::linear, AddressMode::periodic, AddressMode::mirror,
                                 most};
      const Rgba64 ours = sampler.sample(u, v, {dudx, dvdx, dudy, dvdy}, modes, none);
      // Its arc tangent and exponential are the fast ones.
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(ours[c], theirs[c], 3e-4) << i;
      const auto ellipse = sampler.ellipse({dudx, dvdx, dudy, dvdy});
      several += ellipse.major > 1.5 * std::max(ellipse.minor, 0.5);
    }
  }
  EXPECT_GT(several, 500);
  OIIO::TextureSystem::destroy(system);
}

}  // namespace
}  // namespace nacre
