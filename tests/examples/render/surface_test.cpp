#include "examples/render/surface.h"

#include <gtest/gtest.h>

#include "examples/render/builtin_scene.h"
#include "examples/render/bvh.h"
#include "examples/render/mesh.h"

namespace nacre::host {
namespace {

Capabilities everything() {
  Capabilities c;
  c.attributes = attribute_object_space | attribute_tangents | attribute_surface_derivatives |
                 attribute_footprint_position | attribute_footprint_uv | attribute_ids;
  c.matrix_entries = ~0u;
  return c;
}

Vec3 plane_point(const PixelCamera::Ray& ray, Vec3 p, Vec3 n) {
  return ray.origin + (dot(p - ray.origin, n) / dot(ray.direction, n)) * ray.direction;
}

void expect_near(Vec3 a, Vec3 b, float tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

// Central differences of neighbouring rays on the plane are an independent
// derivative, exact to second order.
TEST(Footprint, IsTheDerivativeByPixelPosition) {
  Camera camera = look_at({1.f, 2.f, 3.f}, {0.2f, 0.f, -0.3f}, 0.7f);
  for (const float lens : {0.f, 0.2f}) {
    camera.lens_radius = lens;
    const PixelCamera pixels(camera, 200, 100, 1.f);
    const Vec3 n = normalize({0.3f, 1.f, 0.1f});
    const Uniform2 on_lens = {0.9f, 0.2f};
    for (const float x : {20.f, 100.f, 171.f}) {
      for (const float y : {31.f, 77.f}) {
        const PixelCamera::Ray ray = pixels.ray(x, y, on_lens);
        const Vec3 p = plane_point(ray, {}, n);
        Vec3 dPdx, dPdy;
        pixels.footprint(ray.direction, length(p - ray.origin), n, 0.f, dPdx, dPdy);
        const Vec3 right = plane_point(pixels.ray(x + 0.5f, y, on_lens), {}, n) -
                           plane_point(pixels.ray(x - 0.5f, y, on_lens), {}, n);
        const Vec3 down = plane_point(pixels.ray(x, y + 0.5f, on_lens), {}, n) -
                          plane_point(pixels.ray(x, y - 0.5f, on_lens), {}, n);
        expect_near(dPdx, right, 1e-3f * length(right));
        expect_near(dPdy, down, 1e-3f * length(down));
      }
    }
  }
}

TEST(Surface, SphereHasItsClosedFormGeometry) {
  Scene scene;
  scene.meshes.push_back(make_sphere("ball", {1.f, 2.f, 3.f}, 2.f, 128));
  const SurfaceGeometry geometry(scene);
  const PixelCamera camera(look_at({1.f, 2.f, 9.f}, {1.f, 2.f, 3.f}, 0.6f), 64, 64, 1.f);
  BatchBuffer buffer(256, 0, 0);
  std::vector<SurfacePoint> points;
  const auto count = static_cast<std::uint32_t>(scene.meshes[0].triangles.size());
  for (std::uint32_t i = 0; i < 200; ++i) {
    points.push_back({0, (i * 163 + 2000) % count, 0.3f, 0.3f, {0.f, 0.f, 1.f}, true, 4.f, 0.f});
  }
  geometry.fill(points, everything(), camera, buffer);
  const ShadingBatch& b = buffer.batch;
  ASSERT_EQ(b.count, 200u);
  for (std::size_t i = 0; i < b.count; ++i) {
    const Vec3 radial = normalize(load(b.P, i) - Vec3{1.f, 2.f, 3.f});
    expect_near(load(b.N, i), radial, 2e-3f);
    EXPECT_GT(dot(load(b.Ng, i), radial), 0.999f);
    // u runs around from +x over -z; longitude is atan2(-z, x).
    const Vec3 east = normalize({radial.z, 0.f, -radial.x});
    const float latitude = std::asin(radial.y);
    if (std::abs(latitude) < 1.3f) expect_near(load(b.T, i), east, 0.03f);
    EXPECT_NEAR(dot(load(b.T, i), load(b.N, i)), 0.f, 1e-5f);
    EXPECT_GT(load(b.B, i).y, 0.f);  // v goes up
    expect_near(cross(load(b.N, i), load(b.T, i)), load(b.B, i), 1e-5f);
    EXPECT_NEAR(b.uv.y[i], latitude / 3.14159265f + 0.5f, 2e-3f);
    // |dP/dv| = π r; |dP/du| = 2 π r cos(latitude).
    EXPECT_NEAR(length(load(b.dPdv, i)), 6.2831853f, 0.05f);
    // A footprint in uv carries back to the footprint in space.
    const Vec3 back = b.dUVdx.x[i] * load(b.dPdu, i) + b.dUVdx.y[i] * load(b.dPdv, i);
    expect_near(back, load(b.dPdx, i), 1e-3f * length(load(b.dPdx, i)) + 1e-7f);
  }
}

TEST(Surface, ObjectSpaceUndoesTheTransform) {
  Scene scene;
  Mesh mesh = make_sphere("ball", {}, 1.f, 32);
  const Mesh local = mesh;
  // Mirrors, stretches and moves.
  const Affine map = {{-2.f, 0.f, 0.f}, {0.f, 0.5f, 0.f}, {0.f, 0.3f, 1.f}, {5.f, 6.f, 7.f}};
  bake_transform(mesh, map);
  Diagnostics diagnostics;
  ASSERT_TRUE(finish_mesh(mesh, {}, diagnostics));
  scene.meshes.push_back(mesh);
  const SurfaceGeometry geometry(scene);
  const PixelCamera camera({}, 64, 64, 1.f);
  BatchBuffer buffer(64, 0, 0);
  std::vector<SurfacePoint> points;
  for (std::uint32_t i = 0; i < 64; ++i) {
    points.push_back({0, 300 + 41 * i, 0.2f, 0.5f, {0.f, 0.f, 1.f}, false, 1.f, 0.01f});
  }
  geometry.fill(points, everything(), camera, buffer);
  const ShadingBatch& b = buffer.batch;
  for (std::size_t i = 0; i < b.count; ++i) {
    const Vec3 p = load(b.P_object, i);
    expect_near(transform_point(map, p), load(b.P, i), 1e-5f * 10.f);
    EXPECT_GT(dot(load(b.N_object, i), normalize(p)), 0.99f);
    // Outward stays the front, however the map mirrors.
    EXPECT_GT(dot(load(b.Ng, i), load(b.N, i)), 0.9f);
    EXPECT_GT(dot(load(b.P, i) - map.origin, load(b.Ng, i)), 0.f);
    // Rows of a matrix for row vectors: (p, 1) M is P, and (P, 1) times its inverse p.
    const auto through = [i](const MatrixLanes& m, Vec3 v, std::size_t column) {
      return v.x * m[column][i] + v.y * m[4 + column][i] + v.z * m[8 + column][i] +
             m[12 + column][i];
    };
    const Vec3 world = load(b.P, i);
    EXPECT_NEAR(through(b.object_to_world, p, 0), world.x, 1e-4f);
    EXPECT_NEAR(through(b.object_to_world, p, 1), world.y, 1e-4f);
    EXPECT_NEAR(through(b.world_to_object, world, 2), p.z, 1e-4f);
    EXPECT_EQ(through(b.object_to_world, p, 3), 1.f);
    expect_near(transform_vector(map, load(b.dPdx_object, i)), load(b.dPdx, i), 1e-6f);
    // The bitangent follows the uv map, not the handedness.
    EXPECT_GT(dot(load(b.B, i), load(b.dPdv, i)), 0.f);
    EXPECT_GT(dot(load(b.T, i), load(b.dPdu, i)), 0.f);
  }
}

// A mesh without normals has the geometry of one whose triangles share no vertex.
TEST(Surface, FlatFacesAreThoseOfVerticesOfTheirOwn) {
  Mesh mesh = make_sphere("ball", {}, 1.f, 32);
  const Affine map = {{-2.f, 0.f, 0.f}, {0.f, 0.5f, 0.f}, {0.f, 0.3f, 1.f}, {5.f, 6.f, 7.f}};
  bake_transform(mesh, map);
  mesh.normal.clear();
  mesh.tangent.clear();
  Diagnostics diagnostics;
  ASSERT_TRUE(finish_mesh(mesh, {}, diagnostics, MissingNormals::flat));
  Scene scene;
  scene.meshes = {mesh, mesh};
  give_flat_vertices(scene.meshes[1]);
  ASSERT_TRUE(scene.meshes[0].normal.empty());
  ASSERT_EQ(scene.meshes[1].normal.size(), 3 * mesh.triangles.size());
  const SurfaceGeometry geometry(scene);
  const PixelCamera camera({}, 64, 64, 1.f);
  BatchBuffer buffer(128, 0, 0);
  std::vector<SurfacePoint> points;
  for (std::uint32_t i = 0; i < 128; ++i) {
    points.push_back({i % 2, 300 + 41 * (i / 2), 0.2f, 0.5f, {0.f, 0.f, 1.f}, false, 1.f, 0.01f});
    points.back().keeps_normal = true;
  }
  geometry.fill(points, everything(), camera, buffer);
  const ShadingBatch& b = buffer.batch;
  for (std::size_t i = 0; i < b.count; i += 2) {
    expect_near(load(b.N, i), load(b.Ng, i), 0.f);
    EXPECT_GT(dot(load(b.P, i) - map.origin, load(b.N, i)), 0.f);
    expect_near(load(b.N, i), load(b.N, i + 1), 1e-6f);
    expect_near(load(b.T, i), load(b.T, i + 1), 1e-5f);
    expect_near(load(b.B, i), load(b.B, i + 1), 1e-5f);
    expect_near(load(b.N_object, i), load(b.N_object, i + 1), 1e-5f);
    expect_near(load(b.P_object, i), load(b.P_object, i + 1), 0.f);
    EXPECT_NEAR(dot(load(b.T, i), load(b.N, i)), 0.f, 1e-6f);
    EXPECT_GT(dot(load(b.T, i), load(b.dPdu, i)), 0.f);
    EXPECT_GT(dot(load(b.B, i), load(b.dPdv, i)), 0.f);
  }
}

TEST(Surface, FootprintInUvSolvesForSkewedMaps) {
  Scene scene;
  scene.meshes.push_back(make_quad("skewed", {}, {2.f, 0.f, 0.f}, {1.5f, 1.f, 0.f}));
  const SurfaceGeometry geometry(scene);
  const PixelCamera camera(look_at({1.f, 1.f, 4.f}, {1.f, 0.5f, 0.f}, 0.6f), 64, 64, 1.f);
  BatchBuffer buffer(16, 0, 0);
  const Vec3 wo = normalize({0.f, 0.125f, 1.f});
  const std::vector<SurfacePoint> points = {{0, 0, 0.25f, 0.5f, wo, true, 4.f, 0.f},
                                            {0, 0, 0.25f, 0.5f, wo, false, 4.f, 0.1f}};
  geometry.fill(points, everything(), camera, buffer);
  const ShadingBatch& b = buffer.batch;
  for (std::size_t i = 0; i < 2; ++i) {
    const Vec3 x = b.dUVdx.x[i] * load(b.dPdu, i) + b.dUVdx.y[i] * load(b.dPdv, i);
    const Vec3 y = b.dUVdy.x[i] * load(b.dPdu, i) + b.dUVdy.y[i] * load(b.dPdv, i);
    expect_near(x, load(b.dPdx, i), 1e-5f);
    expect_near(y, load(b.dPdy, i), 1e-5f);
    EXPECT_GT(length(y), 0.01f);
  }
}

TEST(Surface, PrimvarsComeByName) {
  Scene scene;
  Mesh mesh = make_quad("card", {}, {1.f, 0.f, 0.f}, {0.f, 1.f, 0.f});
  mesh.primvars.push_back({"color0", 3, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}});
  scene.meshes.push_back(mesh);
  const SurfaceGeometry geometry(scene);
  Capabilities needs;
  needs.primvars = {{"color0", 4}, {"density", 1}};
  BatchBuffer buffer(16, 0, 2);
  const std::vector<SurfacePoint> points = {{0, 0, 0.25f, 0.5f, {0.f, 0.f, 1.f}, false, 1.f, 0.f}};
  geometry.fill(points, needs, PixelCamera({}, 8, 8, 1.f), buffer);
  EXPECT_EQ(buffer.batch.primvars[0].present[0], 1);
  EXPECT_EQ(buffer.batch.primvars[1].present[0], 0);
  // Colour is (u, v, 0) of the quad.
  EXPECT_FLOAT_EQ(buffer.batch.primvars[0].component[0][0], buffer.batch.uv.x[0]);
  EXPECT_FLOAT_EQ(buffer.batch.primvars[0].component[1][0], buffer.batch.uv.y[0]);
  EXPECT_EQ(buffer.batch.primvars[0].component[3][0], 1.f);
}

TEST(Mesh, BadTrianglesAreLeftOutWithAWarning) {
  Mesh mesh;
  const float nan = std::nanf("");
  mesh.position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {nan, 0, 0}, {2, 0, 0}};
  mesh.triangles = {{{0, 1, 2}}, {{0, 1, 3}}, {{0, 1, 4}}, {{0, 1, 77}}};
  Diagnostics diagnostics;
  EXPECT_TRUE(finish_mesh(mesh, {"f", 0, 0, {}}, diagnostics));
  EXPECT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(diagnostics.warning_count(), 1u);
  mesh.triangles.clear();
  EXPECT_FALSE(finish_mesh(mesh, {"f", 0, 0, {}}, diagnostics));
  EXPECT_TRUE(diagnostics.has_errors());
}

}  // namespace
}  // namespace nacre::host
