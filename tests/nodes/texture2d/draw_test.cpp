// Look-ups that draw one texel.
#include "nodes/texture2d/draw.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "nodes/texture2d/sampler.h"
#include "runtime/node/drawn_texels.h"
#include "tests/nodes/texture2d/lookups.h"
#include "tests/runtime/texture/test_image.h"

namespace nacre {
namespace {

constexpr int width = 13, height = 7;

class DrawnTexels : public testing::Test {
 protected:
  void write(const char* file, const char* type, int steps) {
    WriteOptions options;
    options.type = type;
    path_ = folder_.file(file);
    ASSERT_TRUE(write_image(path_, random_image(width, height, 3, steps), options));
    reference_ = ReferenceSampler::open(path_);
    ASSERT_TRUE(reference_.has_value());
  }

  /// `of`: what is made of the look-up.
  RecordedLookup record(const TextureModes& mode, bool draws,
                        const std::function<Float4(Float4)>& of) {
    return RecordedLookup(store_, [&](Recorder& recorder, TextureProvider& textures, Float2 uv) {
      if (draws) offer_drawn_texels(recorder);
      const ImageLookup lookup{
          .uv = uv, .modes = mode, .channels = 3, .otherwise = {0.5f, 0.25f, 0.125f, 1.0f}};
      TextureSources sources = textures.find(path_, "");
      sources.max_anisotropy = mode.max_anisotropy;
      return of(sample_images(recorder, sources, lookup));
    });
  }
  RecordedLookup record(const TextureModes& mode, bool draws = true) {
    return record(mode, draws, [](Float4 found) { return found; });
  }

  /// One of the points, over all numbers that draw.
  static LookupPoints all_draws(const LookupPoints& points, std::size_t i, int count) {
    LookupPoints all;
    for (int k = 0; k < count; ++k) {
      all.add(points.u[i], points.v[i],
              {points.dudx[i], points.dvdx[i], points.dudy[i], points.dvdy[i]});
      all.draw.push_back((static_cast<float>(k) + 0.5f) / static_cast<float>(count));
    }
    return all;
  }

  TextureStore store_;
  TemporaryFolder folder_;
  std::string path_;
  std::optional<ReferenceSampler> reference_;
};

// The mean over all numbers is the filtered image, of a sampler in double precision that knows
// nothing of drawing. With so many numbers each of the probes' texels, 2 * 15 * 16 at most, begins
// and ends in the midst of one.
TEST_F(DrawnTexels, AreTheFilteredImageOnAverage) {
  constexpr int count = 1 << 14;
  write("a.exr", "float", 1 << 20);
  for (const TextureFilter filter : {TextureFilter::linear, TextureFilter::cubic}) {
    for (const AddressMode mode :
         {AddressMode::constant, AddressMode::clamp, AddressMode::periodic, AddressMode::mirror}) {
      for (const int anisotropy : {1, 8}) {
        const TextureModes modes{filter, mode, mode, anisotropy};
        const RecordedLookup lookup = record(modes);
        const LookupPoints points = random_points(12, width, height, 17);
        for (std::size_t i = 0; i < points.size(); ++i) {
          std::array<double, 3> mean{};
          for (const auto& texel : lookup.run(all_draws(points, i, count))) {
            for (std::size_t c = 0; c < 3; ++c) mean[c] += double{texel[c]} / count;
          }
          const Rgba64 exact =
              reference_->sample(points.u[i], points.v[i], points.footprint(i),
                                 {filter, mode, mode, anisotropy}, {0.5, 0.25, 0.125, 1.0});
          for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(mean[c], exact[c], 4e-3)
                << static_cast<int>(filter) << ' ' << static_cast<int>(mode) << ' ' << anisotropy
                << ' ' << points.u[i] << ' ' << points.v[i];
          }
        }
      }
    }
  }
}

// What comes back is in the file: nothing is mixed.
TEST_F(DrawnTexels, AreTexels) {
  write("b.png", "uint8", 255);
  std::set<std::array<float, 3>> texels;
  const RecordedLookup closest =
      record({TextureFilter::closest, AddressMode::clamp, AddressMode::clamp, 1}, false);
  LookupPoints centres;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      centres.add((static_cast<float>(x) + 0.5f) / width, (static_cast<float>(y) + 0.5f) / height);
    }
  }
  for (const auto& texel : closest.run(centres)) texels.insert({texel[0], texel[1], texel[2]});
  LookupPoints points = random_points(3000, width, height, 5);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points.dudx[i] = points.dvdx[i] = points.dudy[i] = points.dvdy[i] = 0;  // Of the file's level.
    points.draw.push_back(static_cast<float>(i) / 3000.0f);
  }
  for (const TextureFilter filter : {TextureFilter::linear, TextureFilter::cubic}) {
    const RecordedLookup lookup = record({filter, AddressMode::periodic, AddressMode::mirror, 8});
    for (const auto& texel : lookup.run(points)) {
      ASSERT_TRUE(texels.contains({texel[0], texel[1], texel[2]}));
    }
  }
}

// Normals of heights need slopes, which one texel has not.
TEST_F(DrawnTexels, LeaveDerivativesWhole) {
  write("c.exr", "float", 1 << 20);
  const auto slopes = [](Float4 found) -> Float4 {
    return {footprint_derivative(found.x, 0), footprint_derivative(found.y, 1),
            footprint_derivative(found.x * found.z, 0), 0.0f};
  };
  const TextureModes modes{TextureFilter::linear, AddressMode::periodic, AddressMode::periodic, 4};
  LookupPoints points = random_points(500, width, height, 9);
  points.draw.assign(500, 0.37f);
  const auto drawn = record(modes, true, slopes).run(points);
  const auto whole = record(modes, false, slopes).run(points);
  int different = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_EQ(drawn[i][0], whole[i][0]);
    ASSERT_EQ(drawn[i][1], whole[i][1]);
    different += drawn[i][2] != whole[i][2] ? 1 : 0;  // Of a product: drawn values, whole slopes.
  }
  EXPECT_GT(different, 100);
}

// And the kernel that needs none of them does not filter: one texel in place of eight a probe.
TEST_F(DrawnTexels, CostOneTexel) {
  write("d.exr", "float", 1 << 20);
  const auto texels = [&](bool draws) {
    const RecordedLookup lookup =
        record({TextureFilter::linear, AddressMode::periodic, AddressMode::periodic, 8}, draws);
    std::size_t found = 0;
    for (const Function& function : lookup.program().functions) {
      found +=
          static_cast<std::size_t>(std::ranges::count(function.code, Op::texel, &Instruction::op));
    }
    return found;
  };
  EXPECT_GT(texels(false), texels(true) + 12);
}

// A host's numbers may be wrong; what is read lies in the image.
TEST_F(DrawnTexels, AnyNumberDrawsSomething) {
  write("e.png", "uint8", 255);
  const RecordedLookup lookup =
      record({TextureFilter::cubic, AddressMode::clamp, AddressMode::mirror, 8});
  LookupPoints points = random_points(600, width, height, 21);
  for (std::size_t i = 0; i < points.size(); ++i) {
    constexpr std::array hostile{-1.0f,      1.0f,
                                 2.0f,       -0.0f,
                                 1e30f,      std::numeric_limits<float>::infinity(),
                                 -HUGE_VALF, std::numeric_limits<float>::quiet_NaN()};
    points.draw.push_back(hostile[i % hostile.size()]);
  }
  for (const auto& texel : lookup.run(points)) {
    for (std::size_t c = 0; c < 3; ++c) ASSERT_TRUE(texel[c] >= 0 && texel[c] <= 1);
  }
}

}  // namespace
}  // namespace nacre
