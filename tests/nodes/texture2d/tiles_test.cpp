#include <gtest/gtest.h>

#include <cmath>

#include "nodes/texture2d/sampler.h"
#include "tests/nodes/texture2d/lookups.h"
#include "tests/runtime/texture/test_image.h"

namespace nacre {
namespace {

constexpr std::array<float, 4> fallback{0.125f, 0.25f, 0.75f, 0.5f};

class TilesTest : public testing::Test {
 protected:
  void write(const std::string& name, int width, int height, int channels, unsigned seed,
             const char* type = "uint8") {
    WriteOptions options;
    options.type = type;
    ASSERT_TRUE(
        write_image(folder_.file(name), random_image(width, height, channels, 255, seed), options));
  }

  RecordedLookup record(TextureStore& store, const std::string& name) const {
    return RecordedLookup(store, [&](Recorder& recorder, TextureProvider& textures, Float2 uv) {
      const ImageLookup lookup{.uv = uv,
                               .otherwise = {fallback[0], fallback[1], fallback[2], fallback[3]}};
      return sample_images(recorder, textures.find(folder_.file(name), ""), lookup);
    });
  }

  /// Each tile is an image of its own, clamped at its edges.
  Rgba64 exact(const std::string& name, const LookupPoints& points, std::size_t i) const {
    const auto tile = ReferenceSampler::open(folder_.file(name));
    if (!tile) return {fallback[0], fallback[1], fallback[2], fallback[3]};
    const ReferenceModes clamp{TextureFilter::linear, AddressMode::clamp, AddressMode::clamp,
                               default_anisotropy};
    const double u = points.u[i];
    const double v = points.v[i];
    return tile->sample(u - std::floor(u), v - std::floor(v), points.footprint(i), clamp, {});
  }

  TemporaryFolder folder_;
};

LookupPoints points_in(int columns, int rows) {
  LookupPoints points;
  for (int i = 0; i < 700; ++i) {
    const float u = std::fmod(0.0371f * static_cast<float>(i), static_cast<float>(columns) + 2);
    const float v = std::fmod(0.5173f * static_cast<float>(i), static_cast<float>(rows) + 2);
    const float d = i % 3 == 0 ? 0.3f : 0.0f;
    points.add(u - 1, v - 1, {d, 0, 0, d / 2});
  }
  return points;
}

TEST_F(TilesTest, PointsTakeTheTileTheyLieIn) {
  write("t.1001.png", 16, 16, 4, 1);
  write("t.1002.png", 9, 31, 4, 2);
  write("t.1011.png", 1, 1, 4, 3);
  write("t.1012.png", 5, 5, 1, 4);  // r32f: another format.
  write("t.1022.exr", 5, 5, 1, 4);  // Another extension: of no set.
  TextureStore store;
  const RecordedLookup lookup = record(store, "t.<UDIM>.png");
  const LookupPoints points = points_in(2, 3);
  const auto values = lookup.run(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto u = static_cast<int>(std::floor(points.u[i]));
    const auto v = static_cast<int>(std::floor(points.v[i]));
    const bool known = u >= 0 && u < 10 && v >= 0;
    const Rgba64 expected =
        exact("t." + std::to_string(known ? 1001 + u + 10 * v : 9) + ".png", points, i);
    for (std::size_t c = 0; c < 4; ++c) {
      ASSERT_NEAR(values[i][c], expected[c], 0.5 / 255 + 1e-5) << points.u[i] << ' ' << points.v[i];
    }
  }
}

TEST_F(TilesTest, CoordinatesOutsideEveryTileTakeTheDefault) {
  write("t.1001.png", 4, 4, 4, 1);
  TextureStore store;
  LookupPoints points;
  constexpr float inf = std::numeric_limits<float>::infinity();
  for (const float u : {-1e-9f, 1.0f, 1e8f, -1e8f, 3e38f, inf, -inf, std::nanf("")}) {
    points.add(u, 0.5f);
    points.add(0.5f, u);
  }
  for (const auto& value : record(store, "t.<UDIM>.png").run(points)) EXPECT_EQ(value, fallback);
}

TEST_F(TilesTest, TilesOnTheHostGiveTheSame) {
  for (const char* tile : {"1001", "1002", "1011"}) {
    write(std::string("t.") + tile + ".png", 16, 16, 4, 1);
  }
  TextureOptions none_resident;
  none_resident.budget = 0;
  TextureStore resident;
  TextureStore host(none_resident);
  LookupPoints points;
  for (int i = 0; i < 300; ++i) {
    points.add(0.0117f * static_cast<float>(i) - 0.5f, 0.0093f * static_cast<float>(i) - 0.5f);
  }
  const auto a = record(resident, "t.<UDIM>.png").run(points);
  const auto b = record(host, "t.<UDIM>.png").run(points);
  EXPECT_EQ(host.statistics().tiled_textures, 3u);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(a[i][c], b[i][c], 1e-6);
  }
}

TEST_F(TilesTest, NegativeTiles) {
  write("t.u-1_v0.png", 16, 16, 4, 7);  // u in [-2, -1), v in [-1, 0).
  TextureStore store;
  LookupPoints points;
  points.add(-1.25f, -0.75f);
  points.add(-0.75f, -0.75f);
  const auto values = record(store, "t.<UVTILE>.png").run(points);
  const Rgba64 expected = exact("t.u-1_v0.png", points, 0);
  for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(values[0][c], expected[c], 1e-5);
  EXPECT_EQ(values[1], fallback);
}

}  // namespace
}  // namespace nacre
