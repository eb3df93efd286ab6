// Curvature beside closed forms.
#include "examples/bake_mesh/curvature.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/examples/bake_mesh/mesh_samples.h"

namespace nacre::host {
namespace {

/// A tube around y with the normals of a cylinder, outwards or inwards.
Mesh tube(float radius, bool is_inside_out) {
  Mesh mesh;
  constexpr std::uint32_t around = 64;
  const float sign = is_inside_out ? -1.0f : 1.0f;
  for (std::uint32_t i = 0; i <= around; ++i) {
    const float angle = 2.0f * std::numbers::pi_v<float> * static_cast<float>(i % around) / around;
    const Vec3 n{std::cos(angle), 0.0f, std::sin(angle)};
    for (const float y : {0.0f, 3.0f}) {
      mesh.position.push_back(radius * n + Vec3{0.0f, y, 0.0f});
      mesh.normal.push_back(sign * n);
      mesh.uv.push_back({static_cast<float>(i) / around, y});
    }
  }
  for (std::uint32_t i = 0; i < around; ++i) {
    mesh.triangles.push_back({{2 * i, 2 * i + 1, 2 * i + 2}});
    mesh.triangles.push_back({{2 * i + 2, 2 * i + 1, 2 * i + 3}});
  }
  Diagnostics ignored;
  finish_mesh(mesh, {}, ignored);
  return mesh;
}

TEST(Curvature, OfASphereIsOneOverItsRadius) {
  const Mesh ball = make_sphere("ball", {3.0f, -1.0f, 0.5f}, 0.25f, 32);
  for (const float h : mean_curvature(ball, {})) EXPECT_NEAR(h, 4.0f, 4e-4f);
  // Of one that is drawn twice as large.
  const Affine twice{{2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {5, 0, 0}};
  for (const float h : mean_curvature(ball, twice)) EXPECT_NEAR(h, 2.0f, 2e-4f);
}

TEST(Curvature, OfACylinderIsHalfThatAndNegativeInside) {
  for (const float h : mean_curvature(tube(0.5f, false), {})) EXPECT_NEAR(h, 1.0f, 1e-4f);
  for (const float h : mean_curvature(tube(0.5f, true), {})) EXPECT_NEAR(h, -1.0f, 1e-4f);
}

TEST(Curvature, OfFlatFacesIsNone) {
  const Mesh quad = make_quad("quad", {}, {2, 0, 0}, {0, 0, -3});
  for (const float h : mean_curvature(quad, {})) EXPECT_EQ(h, 0.0f);
  // A cube, whose sides have normals of their own.
  for (const Vec3 side : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    const Vec3 along = perpendicular(side);
    for (const float h : mean_curvature(make_quad("side", side, along, cross(side, along)), {})) {
      EXPECT_NEAR(h, 0.0f, 1e-6f);
    }
  }
}

/// A saddle z = (x^2 - y^2) / 2 bends as much one way as the other.
TEST(Curvature, OfASaddleIsNoneInTheMiddle) {
  Mesh mesh;
  constexpr int n = 21;
  const auto at = [](int i) { return 0.02f * static_cast<float>(i - n / 2); };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const float x = at(i), y = at(j);
      mesh.position.push_back({x, y, 0.5f * (x * x - y * y)});
      mesh.normal.push_back(normalize({-x, y, 1.0f}));
    }
  }
  for (std::uint32_t j = 0; j + 1 < n; ++j) {
    for (std::uint32_t i = 0; i + 1 < n; ++i) {
      const std::uint32_t a = j * n + i;
      mesh.triangles.push_back({{a, a + 1, a + n}});
      mesh.triangles.push_back({{a + 1, a + n + 1, a + n}});
    }
  }
  const std::vector<float> h = mean_curvature(mesh, {});
  EXPECT_NEAR(h[n * (n / 2) + n / 2], 0.0f, 1e-3f);
}

}  // namespace
}  // namespace nacre::host
