// What rays find, beside closed forms.
#include "examples/bake_mesh/transport.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/examples/bake_mesh/mesh_samples.h"

namespace nacre::host {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

class Transport : public ::testing::Test {
 protected:
  void trace(std::vector<Mesh> meshes) {
    Scene scene;
    scene.meshes = std::move(meshes);
    bvh_ = std::make_unique<Bvh>(scene, diagnostics_);
    ASSERT_TRUE(bvh_->ok());
  }

  static TransportPoint point(Vec3 p, Vec3 n) { return {p, n, n, 7}; }

  Diagnostics diagnostics_;
  std::unique_ptr<Bvh> bvh_;
};

Mesh floor_quad() { return make_quad("floor", {-1e4f, 0, 1e4f}, {2e4f, 0, 0}, {0, 0, -2e4f}); }

/// At x = 0, its front towards +x.
Mesh wall_quad(float height) {
  return make_quad("wall", {0, 0, 1e4f}, {0, 0, -2e4f}, {0, height, 0});
}

TEST_F(Transport, APlaneAndASphereAreOpen) {
  trace({floor_quad()});
  const Openness open = openness(*bvh_, point({1, 0, 2}, {0, 1, 0}), {});
  EXPECT_EQ(open.ambient, 1.0f);
  EXPECT_NEAR(open.bent.y, 1.0f, 1e-4f);
  trace({make_sphere("ball", {}, 2.0f, 32)});
  const Vec3 n = normalize({1, 2, -3});
  EXPECT_EQ(openness(*bvh_, point(2.0f * n, n), {}).ambient, 1.0f);
}

/// The form factor of a wall at a right angle, infinitely long, of height h in distance x is
/// (1 - x / sqrt(x^2 + h^2)) / 2.
TEST_F(Transport, AWallTakesItsFormFactor) {
  for (const float height : {0.5f, 1.0f, 3.0f}) {
    trace({floor_quad(), wall_quad(height)});
    for (const float x : {0.1f, 0.7f, 2.0f}) {
      const float factor = 0.5f * (1.0f - x / std::sqrt(x * x + height * height));
      const Openness open = openness(*bvh_, point({x, 0, 0}, {0, 1, 0}), {.rays = 4096});
      EXPECT_NEAR(open.ambient, 1.0f - factor, 3e-3f) << height << ' ' << x;
    }
  }
}

/// Of a high wall in distance x those directions count that meet it within D: projected to the
/// floor's disc, the segment beyond x/D (Nusselt's analogue).
TEST_F(Transport, NothingBeyondTheDistanceIsMet) {
  trace({floor_quad(), wall_quad(1e4f)});
  for (const float c : {0.2f, 0.5f, 0.9f}) {
    const float segment = (std::acos(c) - c * std::sqrt(1.0f - c * c)) / pi;
    const Openness open =
        openness(*bvh_, point({c, 0, 0}, {0, 1, 0}), {.rays = 4096, .distance = 1.0f});
    EXPECT_NEAR(open.ambient, 1.0f - segment, 3e-3f) << c;
  }
  EXPECT_EQ(openness(*bvh_, point({1.1f, 0, 0}, {0, 1, 0}), {.distance = 1.0f}).ambient, 1.0f);
}

/// The mean of directions before a high wall, by their cosines: (2 / 3 pi, 1/3, 0).
TEST_F(Transport, NormalsBendAwayFromAWall) {
  trace({floor_quad(), wall_quad(1e4f)});
  const Openness open = openness(*bvh_, point({0.5f, 0, 0}, {0, 1, 0}), {.rays = 4096});
  const Vec3 right = normalize({2.0f / pi, 1.0f, 0.0f});
  EXPECT_NEAR(open.bent.x, right.x, 3e-3f);
  EXPECT_NEAR(open.bent.y, right.y, 3e-3f);
  EXPECT_NEAR(open.bent.z, 0.0f, 3e-3f);
}

/// The form factor of a sphere of radius r straight above in distance h is (r/h)^2.
TEST_F(Transport, ASphereAboveTakesItsFormFactor) {
  trace({floor_quad(), make_sphere("ball", {0, 2, 0}, 1.0f, 96)});
  EXPECT_NEAR(openness(*bvh_, point({0, 0, 0}, {0, 1, 0}), {.rays = 4096}).ambient, 0.75f, 3e-3f);
}

/// Inside a sphere rays of less than D end where the cosine is below D / 2r, half of which is
/// (D / 2r)^2 of all.
TEST_F(Transport, ASphereIsOpenAsFarAsTheDistance) {
  trace({make_sphere("ball", {}, 1.0f, 96)});
  const TransportPoint inside = point({0, -1, 0}, {0, 1, 0});
  for (const float d : {0.5f, 1.0f, 1.5f}) {
    const Openness open = openness(*bvh_, inside, {.rays = 4096, .distance = d});
    EXPECT_NEAR(open.ambient, 1.0f - 0.25f * d * d, 5e-3f) << d;
  }
}

TEST_F(Transport, ThicknessOfASphereAndAPlate) {
  trace({make_sphere("ball", {}, 3.0f, 96)});
  EXPECT_NEAR(thickness(*bvh_, point({0, 3, 0}, {0, 1, 0}), {.rays = 4096}), 4.0f, 2e-2f);
  trace({make_quad("top", {-1e4f, 0, 1e4f}, {2e4f, 0, 0}, {0, 0, -2e4f}),
         make_quad("bottom", {-1e4f, -0.5f, -1e4f}, {2e4f, 0, 0}, {0, 0, 2e4f})});
  // The tail of 1 / cosine is slow.
  EXPECT_NEAR(thickness(*bvh_, point({0, 0, 0}, {0, 1, 0}), {.rays = 65536}), 1.0f, 1e-2f);
  // Of rays that meet nothing as far as that, the distance counts: those of cosines below 1/2.
  const float limited =
      thickness(*bvh_, point({0, 0, 0}, {0, 1, 0}), {.rays = 4096, .distance = 1});
  EXPECT_NEAR(limited, 2.0f * 0.5f * 0.5f + 0.25f, 5e-3f);
}

/// From the middle of a side of a unit cube, beside the integral over directions.
TEST_F(Transport, ACubeIsOpenAndAsThickAsItIs) {
  std::vector<Mesh> sides;
  for (const Vec3 n : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1},
                       Vec3{0, 0, -1}}) {
    const Vec3 along = perpendicular(n), across = cross(n, along);
    sides.push_back(make_quad("side", 0.5f * (n - along - across), along, across));
  }
  trace(std::move(sides));
  const TransportPoint top = point({0, 0.5f, 0}, {0, 1, 0});
  EXPECT_EQ(openness(*bvh_, top, {}).ambient, 1.0f);
  double sum = 0.0, weight = 0.0;
  constexpr int steps = 400;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      const double theta = (i + 0.5) / steps * std::numbers::pi / 2;
      const double phi = (j + 0.5) / steps * 2 * std::numbers::pi;
      const double x = std::sin(theta) * std::cos(phi), z = std::sin(theta) * std::sin(phi);
      const double side = 0.5 / std::max(std::abs(x), std::abs(z));
      const double length = std::min(1.0 / std::cos(theta), side);
      const double w = std::cos(theta) * std::sin(theta);
      sum += w * length;
      weight += w;
    }
  }
  EXPECT_NEAR(thickness(*bvh_, top, {.rays = 4096}), static_cast<float>(sum / weight), 3e-3f);
}

TEST_F(Transport, PointsDoNotShareTheirRays) {
  trace({floor_quad(), wall_quad(1.0f)});
  const TransportPoint one{{1, 0, 0}, {0, 1, 0}, {0, 1, 0}, 1};
  TransportPoint other = one;
  other.seed = 2;
  const TransportSettings few{.rays = 64};
  EXPECT_EQ(openness(*bvh_, one, few).ambient, openness(*bvh_, one, few).ambient);
  EXPECT_NE(openness(*bvh_, one, few).bent.x, openness(*bvh_, other, few).bent.x);
}

}  // namespace
}  // namespace nacre::host
