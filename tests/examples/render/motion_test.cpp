// What moves: maps, hits, shading points and pictures agree on where it is.
#include "examples/render/motion.h"

#include <gtest/gtest.h>

#include <cstring>
#include <numbers>
#include <random>
#include <set>

#include "examples/render/builtin_scene.h"
#include "examples/render/bvh.h"
#include "examples/render/camera.h"
#include "examples/render/mesh.h"
#include "examples/render/render.h"
#include "examples/render/surface.h"
#include "tests/examples/render/statistics.h"
#include "tests/examples/render/test_shaders.h"

namespace nacre::host {
namespace {

Affine turned(float angle, Vec3 origin, float size = 1.f) {
  const float c = size * std::cos(angle), s = size * std::sin(angle);
  return {{c, s, 0.f}, {-s, c, 0.f}, {0.f, 0.f, size}, origin};
}

/// Half a turn on the way right, a jump at 0.4, and a straight way up from there.
Motion various() {
  Motion::Segment turning{0.f, 0.4f, {}}, straight{0.4f, 1.f, {}};
  for (int i = 0; i <= 64; ++i) {
    const float share = static_cast<float>(i) / 64.f;
    turning.steps.push_back(turned(std::numbers::pi_v<float> * share, {share, 0.f, 0.f}));
  }
  straight.steps = {turned(0.3f, {-2.f, -1.f, 0.f}), turned(0.3f, {-2.f, 1.f, 0.5f})};
  // Mirrored, for what only a mirror shows.
  for (Motion::Segment* each : {&turning, &straight}) {
    for (Affine& m : each->steps) m.z = -1.f * m.z;
  }
  return Motion({turning, straight});
}

Mesh card() { return make_quad("card", {-1.f, -1.f, 0.f}, {2.f, 0.f, 0.f}, {0.f, 2.f, 0.f}); }

TEST(Motion, StandsWhereItsStepsSay) {
  const Motion motion = various();
  EXPECT_FALSE(motion.is_still());
  EXPECT_EQ(motion.at(0.f).origin.x, 0.f);
  EXPECT_NEAR(motion.at(0.2f).x.y, 1.f, 1e-6f);  // A quarter turn.
  EXPECT_EQ(motion.at(0.4f).origin.x, -2.f);     // Already behind the jump.
  EXPECT_NEAR(motion.at(0.7f).origin.y, 0.f, 1e-6f);
  EXPECT_NEAR(motion.at(1.f).origin.z, 0.5f, 1e-6f);
  const Affine same = turned(0.2f, {1.f, 2.f, 3.f});
  EXPECT_TRUE(Motion({{0.f, 0.5f, {same, same}}, {0.5f, 1.f, {same, same}}}).is_still());
  EXPECT_TRUE(is_invertible(motion));
  // From a card to its mirror image there is a moment without an inverse.
  EXPECT_FALSE(
      is_invertible(Motion({{0.f, 1.f, {turned(0.f, {}), {{-1.f, 0.f, 0.f}, {0.f, 1.f, 0.f}}}}})));
  // Half a turn in one step comes through a point.
  EXPECT_FALSE(is_invertible(
      Motion({{0.f, 1.f, {turned(0.f, {}), turned(std::numbers::pi_v<float>, {})}}})));
}

TEST(Motion, ProductsHaveTheBoundariesOfBoth) {
  const Motion outer({{0.f, 0.25f, {turned(0.f, {}), turned(0.f, {1.f, 0.f, 0.f})}},
                      {0.25f, 1.f, {turned(0.f, {5.f, 0.f, 0.f}), turned(0.f, {5.f, 3.f, 0.f})}}});
  const Motion inner = various();
  const Motion both = outer * inner;
  ASSERT_EQ(both.segments().size(), 3u);
  EXPECT_LE(both.steps(), steps_of_product(outer, inner));
  for (const float time : {0.f, 0.1f, 0.2499f, 0.25f, 0.39f, 0.4f, 0.77f, 1.f}) {
    const Vec3 p = {0.3f, -0.2f, 0.1f};
    const Vec3 expected = transform_point(outer.at(time), transform_point(inner.at(time), p));
    const Vec3 found = transform_point(both.at(time), p);
    EXPECT_LT(length(found - expected), 2e-3f) << time;
  }
  // A chord of 0.05 radians stays within 1/3000 of the radius.
  EXPECT_EQ(steps_for_angle(0.0), 1);
  EXPECT_EQ(steps_for_angle(0.05), 1);
  EXPECT_EQ(steps_for_angle(-0.06), 2);
  EXPECT_EQ(steps_for_angle(6.3), 128);
  EXPECT_EQ(steps_for_angle(INFINITY), 128);
}

// Embree's hit distance says where the ray met the card; our matrix says where that point of the
// card is. Both have to be the same place.
TEST(Motion, ShadingStandsWhereRaysMeet) {
  Scene scene;
  scene.meshes.push_back(card());
  scene.meshes.back().instances = {various(), Motion(turned(0.5f, {0.f, 4.f, 0.f}, 0.5f))};
  scene.meshes.push_back(make_quad("wall", {-9.f, -9.f, -3.f}, {18.f, 0.f, 0.f}, {0.f, 18.f, 0.f}));
  Diagnostics diagnostics;
  const Bvh bvh(scene, diagnostics);
  ASSERT_TRUE(bvh.ok());
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(0.f, 1.f);
  std::vector<Ray> rays;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 from = {8.f * unit(random) - 4.f, 10.f * unit(random) - 4.f, 5.f};
    const Vec3 towards = normalize({unit(random) - 0.5f, unit(random) - 0.5f, -2.f});
    rays.push_back({from, towards, INFINITY, ray_any, unit(random)});
  }
  std::vector<Hit> hits(rays.size());
  bvh.intersect(rays, hits, false);
  std::vector<std::uint8_t> blocked(rays.size());
  bvh.occluded(rays, blocked);
  std::set<std::pair<std::uint32_t, std::uint32_t>> met;
  int moved = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Hit& hit = hits[i];
    EXPECT_EQ(blocked[i] != 0, !hit.missed());
    if (hit.missed()) continue;
    const Ray& ray = rays[i];
    const SurfacePoint p = {hit.mesh, hit.triangle, hit.u, hit.v,        -ray.direction,
                            false,    0.f,          0.f,   hit.instance, ray.time};
    const Vec3 shaded = surface_position(scene, p);
    EXPECT_LT(length(shaded - (ray.origin + hit.distance * ray.direction)), 2e-5f) << i;
    EXPECT_LT(std::abs(dot(surface_normal(scene, p), surface_normal(scene, p)) - 1.f), 1e-5f);
    met.insert({hit.mesh, hit.instance});
    moved += hit.mesh == 0 && hit.instance == 0;
  }
  EXPECT_EQ(met.size(), 3u);
  EXPECT_GT(moved, 500);
}

/// Glows by where the point is in its own space, and keeps what it was told.
class ChequerShader final : public LambertShader {
 public:
  ChequerShader() : LambertShader({0.f, 0.f, 0.f}, {1.f, 1.f, 1.f}) {}
  Capabilities capabilities() const override {
    Capabilities c = LambertShader::capabilities();
    c.attributes = attribute_object_space | attribute_tangents | attribute_time;
    c.matrix_entries = ~0u;
    return c;
  }
  void emission(const ShadingBatch& batch, Lanes3 radiance) const override {
    ++calls;
    for (std::size_t i = 0; i < batch.count; ++i) {
      const Vec3 own = load(batch.P_object, i);
      const bool odd = (own.x > 0.1f) != (own.y > -0.2f);
      store(radiance, i, odd ? Vec3{1.f, 0.1f, 0.f} : Vec3{0.f, 0.2f, batch.times[i]});
      const auto moved = [&](std::size_t k) {
        const MatrixLanes& m = batch.object_to_world;
        return own.x * m[k][i] + own.y * m[4 + k][i] + own.z * m[8 + k][i] + m[12 + k][i];
      };
      const Vec3 off = load(batch.P, i) - Vec3{moved(0), moved(1), moved(2)};
      largest_error = std::max(largest_error, length(off));
      outside += std::abs(own.x) > 1.0001f || std::abs(own.y) > 1.0001f || own.z != 0.f;
      earliest = std::min(earliest, batch.times[i]);
      latest = std::max(latest, batch.times[i]);
      late_frames += std::abs(batch.frames[i] - (7.f + 24.f * (batch.times[i] - 3.f))) > 1e-3f;
      const Vec3 t = load(batch.T, i), n = load(batch.N, i), b = load(batch.B, i);
      // v of the card is +y of its own space, and B follows that through the mirror.
      const Vec3 up = transform_vector(
          {{batch.object_to_world[0][i], batch.object_to_world[1][i], batch.object_to_world[2][i]},
           {batch.object_to_world[4][i], batch.object_to_world[5][i], batch.object_to_world[6][i]},
           {},
           {}},
          {0.f, 1.f, 0.f});
      twisted += dot(b, up) < 0.f || std::abs(dot(t, n)) > 1e-5f;
    }
  }

  mutable int calls = 0, outside = 0, late_frames = 0, twisted = 0;
  mutable float largest_error = 0.f, earliest = INFINITY, latest = -INFINITY;
};

class Blur : public ::testing::Test {
 protected:
  Blur() {
    scene_.meshes.push_back(card());
    scene_.meshes.back().instances = {various()};
    settings_.width = settings_.height = 24;
    settings_.samples = 256;
    settings_.max_depth = 0;
    settings_.sampler = SamplerKind::independent;
    settings_.time = 3.f;
    settings_.frame = 7.f;
    settings_.threads = 1;
  }

  Film rendered(const ChequerShader& shader) {
    Diagnostics diagnostics;
    auto film = render({&scene_, {&shader}, nullptr, look_at({0, 0, 9}, {0, 0, 0}, 0.7f)},
                       settings_, diagnostics);
    EXPECT_TRUE(film) << diagnostics.to_string();
    return film ? *std::move(film) : Film(24, 24);
  }

  Scene scene_;
  RenderSettings settings_;
};

TEST_F(Blur, PointsKnowTheirTimeAndTheirMatrix) {
  settings_.shutter_open = -0.5f;
  settings_.shutter_close = 0.5f;
  settings_.samples = 16;
  settings_.batch_size = 4096;
  const ChequerShader shader;
  rendered(shader);
  EXPECT_EQ(shader.outside, 0);  // The pattern is where the card has it.
  EXPECT_EQ(shader.late_frames, 0);
  EXPECT_EQ(shader.twisted, 0);
  EXPECT_LT(shader.largest_error, 1e-5f);
  EXPECT_GT(shader.earliest, 2.499f);
  EXPECT_LT(shader.earliest, 2.51f);
  EXPECT_GT(shader.latest, 3.49f);
  EXPECT_LT(shader.latest, 3.501f);
  // 9,216 paths in waves of 4,032, all with their own time: one call a wave.
  EXPECT_EQ(shader.calls, 3);
}

TEST_F(Blur, IsTheMeanOfManySharpPictures) {
  settings_.shutter_open = -0.5f;
  settings_.shutter_close = 0.5f;
  const ChequerShader shader;
  const Film blurred = rendered(shader);
  constexpr int pictures = 128;
  const Motion motion = various();
  settings_.shutter_open = settings_.shutter_close = 0.f;
  settings_.samples = 4;
  std::vector<Film> sharp;
  for (int i = 0; i < pictures; ++i) {
    const float time = (static_cast<float>(i) + 0.5f) / pictures;
    scene_.meshes[0].instances = {Motion(motion.at(time))};
    settings_.time = 2.5f + time;
    settings_.seed = 1 + static_cast<std::uint32_t>(i);
    sharp.push_back(rendered(shader));
  }
  // 16 blocks of three channels at 1 % together: 3.71 sigma. Jumps and edges that pass a block
  // within 1/128 of the time are what the mean of pictures does not know.
  int lit = 0;
  for (int y = 0; y < 24; y += 6) {
    for (int x = 0; x < 24; x += 6) {
      for (int c = 0; c < 3; ++c) {
        Estimate mean;
        for (const Film& each : sharp) {
          const Estimate e = estimate(each, c, x, y, x + 6, y + 6);
          mean.mean += e.mean / pictures;
          mean.variance += e.variance / (pictures * pictures);
        }
        const Estimate e = estimate(blurred, c, x, y, x + 6, y + 6);
        const double allowed = 3.71 * std::sqrt(e.variance + mean.variance) + 0.02 * e.mean + 2e-3;
        EXPECT_LE(std::abs(e.mean - mean.mean), allowed) << x << ' ' << y << ' ' << c;
        lit += e.mean > 0.05;
      }
    }
  }
  EXPECT_GT(lit, 10);
}

TEST_F(Blur, OfWhatStandsStillIsNone) {
  scene_.meshes[0].instances = {Motion(turned(0.4f, {0.1f, 0.2f, 0.f}))};
  settings_.samples = 8;
  const ChequerShader shader;
  settings_.shutter_open = settings_.shutter_close = 1e-30f;
  const Film closed = rendered(shader);
  const Vec3* a = closed.pixels().data();
  settings_.shutter_close = 2e-30f;
  const Film open = rendered(shader);
  EXPECT_EQ(std::memcmp(a, open.pixels().data(), closed.pixels().size() * sizeof(Vec3)), 0);
}

TEST(Instances, AreWhatCopiesWouldBe) {
  Scene copies, instances;
  Mesh ball = make_sphere("ball", {}, 0.5f, 32);
  Diagnostics diagnostics;
  std::vector<Motion> places;
  for (int i = 0; i < 4; ++i) {
    const auto x = static_cast<float>(i);
    Affine map = turned(0.7f * x, {1.2f * x - 1.8f, 0.1f * x, 0.f}, 1.f);
    map.x = 0.8f * map.x;
    if (i == 2) map.z = -1.f * map.z;
    places.emplace_back(map);
    Mesh copy = ball;
    bake_transform(copy, map);
    ASSERT_TRUE(finish_mesh(copy, {}, diagnostics));
    copies.meshes.push_back(std::move(copy));
  }
  ball.instances = places;
  instances.meshes.push_back(ball);
  const Bounds a = bounds(copies), b = bounds(instances);
  EXPECT_LE(b.low.x, a.low.x + 1e-5f);
  EXPECT_GE(b.high.y, a.high.y - 1e-5f);
  const LambertShader grey({0.6f, 0.5f, 0.4f});
  const Environment sky = Environment::studio();
  RenderSettings s;
  s.width = 48, s.height = 24;
  s.samples = 16;
  s.max_depth = 3;
  const Camera camera = look_at({0.f, 1.f, 6.f}, {}, 0.5f);
  const auto first = render({&copies, {&grey, &grey, &grey, &grey}, &sky, camera}, s, diagnostics);
  RenderStatistics statistics;
  const auto second = render({&instances, {&grey}, &sky, camera}, s, diagnostics, {}, &statistics);
  ASSERT_TRUE(first && second) << diagnostics.to_string();
  EXPECT_EQ(statistics.invalid_results, 0u);
  // The same paths but for roundings: few pixels see one that goes another way.
  int other = 0;
  for (int y = 0; y < s.height; ++y) {
    for (int x = 0; x < s.width; ++x) {
      other += length(first->mean(x, y) - second->mean(x, y)) > 1e-3f * length(first->mean(x, y));
    }
  }
  EXPECT_LT(other, s.width * s.height / 50);
}

TEST(CameraMotion, MovesRaysAndFootprints) {
  const Camera camera = look_at({1.f, 2.f, 6.f}, {0.f, 0.f, 0.f}, 0.6f);
  const Affine moved = turned(0.3f, {0.5f, -0.25f, 1.f});
  const Motion motion({{0.f, 1.f, {Affine(), moved}}});
  const PixelCamera still(camera, 64, 48, 1.f), moving(camera, 64, 48, 1.f, motion);
  const PixelCamera::Ray a = still.ray(10.f, 20.f, {0.5f, 0.5f});
  const PixelCamera::Ray at_0 = moving.ray(10.f, 20.f, {0.5f, 0.5f}, 0.f);
  const PixelCamera::Ray at_1 = moving.ray(10.f, 20.f, {0.5f, 0.5f}, 1.f);
  EXPECT_LT(length(a.direction - at_0.direction), 1e-6f);
  EXPECT_LT(length(transform_point(moved, a.origin) - at_1.origin), 1e-6f);
  EXPECT_LT(length(transform_vector(moved, a.direction) - at_1.direction), 1e-6f);
  Vec3 x, y, moved_x, moved_y;
  const Vec3 n = normalize({0.1f, 0.9f, 0.5f});
  still.footprint(a.direction, 5.f, n, 0.f, x, y);
  moving.footprint(at_1.direction, 5.f, transform_vector(moved, n), 1.f, moved_x, moved_y);
  EXPECT_LT(length(transform_vector(moved, x) - moved_x), 1e-5f * length(x));
  EXPECT_LT(length(transform_vector(moved, y) - moved_y), 1e-5f * length(y));
}

}  // namespace
}  // namespace nacre::host
