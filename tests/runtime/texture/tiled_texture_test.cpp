#include "runtime/texture/tiled_texture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "runtime/texture/texture_store.h"
#include "tests/runtime/texture/reference_sampler.h"
#include "tests/runtime/texture/test_image.h"

namespace nacre {
namespace {

TextureOptions budget_of(std::uint64_t bytes) {
  TextureOptions options;
  options.budget = bytes;
  return options;
}

constexpr std::array filters{TextureFilter::closest, TextureFilter::linear, TextureFilter::cubic};
constexpr std::array address_modes{AddressMode::clamp, AddressMode::periodic, AddressMode::mirror};

struct Lookups {
  std::vector<float> u, v, dudx, dvdx, dudy, dvdy;
  std::array<std::vector<float>, 4> rgba;

  void run(const TextureSampler& texture, const ReferenceModes& modes) {
    TextureLookup lookup{static_cast<int>(u.size()),
                         u.data(),
                         v.data(),
                         nullptr,
                         nullptr,
                         nullptr,
                         nullptr,
                         modes.filter,
                         modes.u,
                         modes.v,
                         modes.max_anisotropy};
    if (!dudx.empty()) {
      lookup.dudx = dudx.data();
      lookup.dvdx = dvdx.data();
      lookup.dudy = dudy.data();
      lookup.dvdy = dvdy.data();
    }
    for (auto& channel : rgba) channel.assign(u.size(), -7.f);
    texture.lookup(lookup, {rgba[0].data(), rgba[1].data(), rgba[2].data(), rgba[3].data()});
  }
};

class TiledTextureTest : public testing::Test {
 protected:
  TextureHandle open(const std::string& name, const TestImage& image, const char* type) {
    WriteOptions options;
    options.type = type;
    EXPECT_TRUE(write_image(folder_.file(name), image, options));
    reference_ = ReferenceSampler::open(folder_.file(name));
    TextureStore store(budget_of(0));
    const TextureHandle texture = store.acquire({folder_.file(name), "", {}}, diagnostics_);
    EXPECT_NE(texture->sampler(), nullptr) << diagnostics_.to_string();
    return texture;
  }

  double worst(const TextureSampler& texture, Lookups& lookups, const ReferenceModes& modes) const {
    lookups.run(texture, modes);
    double result = 0;
    for (std::size_t i = 0; i < lookups.u.size(); ++i) {
      ReferenceFootprint footprint;
      if (!lookups.dudx.empty()) {
        footprint = {lookups.dudx[i], lookups.dvdx[i], lookups.dudy[i], lookups.dvdy[i]};
      }
      const Rgba64 exact = reference_->sample(lookups.u[i], lookups.v[i], footprint, modes, {});
      for (std::size_t c = 0; c < 4; ++c) {
        result = std::max(result, std::fabs(lookups.rgba[c][i] - exact[c]));
      }
    }
    return result;
  }

  TemporaryFolder folder_;
  Diagnostics diagnostics_;
  std::optional<ReferenceSampler> reference_;
};

/// Multiples of 2^-12 (and never the edge of a texel of 40 x 23, where closest may flip).
Lookups random_lookups(int count) {
  Lookups lookups;
  std::mt19937 random(3);
  std::uniform_int_distribution<int> step(-3 * 4096, 3 * 4096);
  for (int i = 0; i < count; ++i) {
    lookups.u.push_back((static_cast<float>(step(random)) + 0.25f) / 4096);
    lookups.v.push_back((static_cast<float>(step(random)) + 0.25f) / 4096);
  }
  return lookups;
}

TEST_F(TiledTextureTest, AgreesWithTheOracleForEveryFilterAndAddressMode) {
  for (const auto& [name, type] : {std::pair{"a.png", "uint8"}, std::pair{"b.exr", "float"}}) {
    for (const int channels : {1, 3, 4}) {
      const TextureHandle texture =
          open(std::to_string(channels) + name, random_image(40, 23, channels, 255), type);
      Lookups lookups = random_lookups(60);
      for (const TextureFilter filter : filters) {
        for (const AddressMode u : address_modes) {
          for (const AddressMode v : address_modes) {
            // Coordinates carry 40 * 2^-23 texels of rounding, on a slope of at most 1.
            EXPECT_LT(worst(*texture->sampler(), lookups, {filter, u, v}), 2e-5);
          }
        }
      }
    }
  }
}

TEST_F(TiledTextureTest, TinyImagesWrapSeveralTimesUnderOneFilter) {
  for (const auto& [width, height] :
       std::initializer_list<std::pair<int, int>>{{1, 1}, {1, 3}, {2, 2}, {3, 1}}) {
    const std::string name = std::to_string(width) + "x" + std::to_string(height) + ".exr";
    const TextureHandle texture = open(name, random_image(width, height, 3, 255), "float");
    Lookups lookups = random_lookups(100);
    for (const AddressMode mode : address_modes) {
      EXPECT_LT(worst(*texture->sampler(), lookups, {TextureFilter::cubic, mode, mode}), 2e-5);
    }
  }
}

TEST_F(TiledTextureTest, FootprintSelectsAndBlendsLevels) {
  const TextureHandle texture = open("a.exr", random_image(64, 64, 3, 255), "float");
  Lookups lookups = random_lookups(80);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> exponent(-9.f, 1.f);
  std::uniform_real_distribution<float> sign(-1.f, 1.f);
  for (std::size_t i = 0; i < lookups.u.size(); ++i) {
    const float size = std::exp2(exponent(random));
    lookups.dudx.push_back(size * sign(random));
    lookups.dvdx.push_back(size * sign(random));
    lookups.dudy.push_back(size * sign(random));
    lookups.dvdy.push_back(size * sign(random));
  }
  for (const TextureFilter filter : filters) {
    for (const int most : {1, 8}) {
      const ReferenceModes modes{filter, AddressMode::periodic, AddressMode::periodic, most};
      EXPECT_LT(worst(*texture->sampler(), lookups, modes), 1e-4);
    }
  }
}

TEST_F(TiledTextureTest, CoordinatesThatAreNotFiniteGiveFiniteTexels) {
  const TextureHandle texture = open("a.png", random_image(40, 23, 3, 255), "uint8");
  constexpr float inf = std::numeric_limits<float>::infinity();
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  Lookups lookups;
  for (const float a : {nan, inf, -inf, 3e38f, -3e38f, 1e-45f, -1e-45f, 16777217.f, -0.f}) {
    for (const float b : {nan, inf, 0.5f, -3e38f}) {
      lookups.u.push_back(a);
      lookups.v.push_back(b);
      lookups.dudx.push_back(b);
      lookups.dvdx.push_back(a);
      lookups.dudy.push_back(a);
      lookups.dvdy.push_back(b);
    }
  }
  for (const TextureFilter filter : filters) {
    for (const AddressMode mode : address_modes) {
      lookups.run(*texture->sampler(), {filter, mode, mode});
      for (const auto& channel : lookups.rgba) {
        for (const float value : channel) {
          EXPECT_TRUE(value >= 0 && value <= 1.0001f) << value;
        }
      }
    }
  }
}

TEST_F(TiledTextureTest, TexelsThatAreNotFiniteAreZero) {
  TestImage image = random_image(4, 4, 3, 255);
  for (float& sample : image.samples) sample = std::numeric_limits<float>::quiet_NaN();
  const TextureHandle texture = open("a.exr", image, "float");
  Lookups lookups = random_lookups(10);
  lookups.run(*texture->sampler(), {});
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(lookups.rgba[0][i], 0.f);
    EXPECT_EQ(lookups.rgba[3][i], 1.f);
  }
}

TEST_F(TiledTextureTest, FileThatVanishesGivesZeroAndIsCounted) {
  const TextureHandle texture = open("a.exr", random_image(64, 64, 3, 255), "float");
  write_file(folder_.file("a.exr"), "gone");
  Lookups lookups = random_lookups(1);
  lookups.run(*texture->sampler(), {TextureFilter::closest});
  // The cache may hold the file open or have the tile already; if not, it is an event.
  if (texture->sampler()->read_failures() > 0) {
    EXPECT_EQ(lookups.rgba[0][0], 0.f);
  } else {
    EXPECT_LT(worst(*texture->sampler(), lookups, {TextureFilter::closest}), 1e-6);
  }
}

}  // namespace
}  // namespace nacre
