#include "examples/render/builtin_scene.h"

#include <cassert>
#include <numbers>
#include <utility>

#include "examples/render/camera.h"
#include "examples/render/mesh.h"

namespace nacre::host {

namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// A point of a profile in the half plane (distance from axis, height).
struct ProfilePoint {
  Vec2 at;
  Vec2 normal;
};

Mesh named(const std::string& name) {
  Mesh mesh;
  mesh.object_name = mesh.mesh_name = mesh.material_name = name;
  return mesh;
}

Mesh finished(Mesh mesh) {
  Diagnostics diagnostics;
  [[maybe_unused]] const bool ok = finish_mesh(mesh, {}, diagnostics);
  assert(ok);
  return mesh;
}

/// Turns a profile, given from bottom to top, around the y axis: u once around
/// from +x over -z, v along the length of the profile.
Mesh turn(const std::string& name, const std::vector<ProfilePoint>& profile, int around) {
  std::vector<float> along = {0.f};
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const Vec2 step = profile[i].at - profile[i - 1].at;
    along.push_back(along.back() + std::hypot(step.x, step.y));
  }
  Mesh mesh = named(name);
  const auto rows = static_cast<std::uint32_t>(profile.size());
  for (int j = 0; j <= around; ++j) {
    const float u = static_cast<float>(j) / static_cast<float>(around);
    // The seam closes exactly: the last column repeats the first.
    const float angle = j == around ? 0.f : 2.f * pi * u;
    const float c = std::cos(angle), s = -std::sin(angle);
    for (std::uint32_t i = 0; i < rows; ++i) {
      const ProfilePoint& p = profile[i];
      mesh.position.push_back({p.at.x * c, p.at.y, p.at.x * s});
      mesh.normal.push_back({p.normal.x * c, p.normal.y, p.normal.x * s});
      mesh.uv.push_back({u, along[i] / along.back()});
    }
  }
  for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(around); ++j) {
    for (std::uint32_t i = 0; i + 1 < rows; ++i) {
      const std::uint32_t a = j * rows + i, b = a + rows;
      if (profile[i].at.x > 0.f) mesh.triangles.push_back({{a, b, a + 1}});
      if (profile[i + 1].at.x > 0.f) mesh.triangles.push_back({{b, b + 1, a + 1}});
    }
  }
  return mesh;
}

/// A flat foot, a cove and a dish; hard edges have two points with own normals.
std::vector<ProfilePoint> pedestal() {
  std::vector<ProfilePoint> p = {{{0.95f, 0.f}, {1.f, 0.f}},
                                 {{0.95f, 0.12f}, {1.f, 0.f}},
                                 {{0.95f, 0.12f}, {0.f, 1.f}},
                                 {{0.85f, 0.12f}, {0.f, 1.f}}};
  constexpr int steps = 24;
  for (int i = 0; i <= steps; ++i) {  // cove: a quarter circle of radius 0.3 about (0.85, 0.42)
    const float a = 0.5f * pi * static_cast<float>(i) / steps;
    p.push_back(
        {{0.85f - 0.3f * std::sin(a), 0.42f - 0.3f * std::cos(a)}, {std::sin(a), std::cos(a)}});
  }
  p.push_back({{0.55f, 0.42f}, {0.f, 1.f}});
  p.push_back({{0.f, 0.42f}, {0.f, 1.f}});
  return p;
}

}  // namespace

Mesh make_sphere(const std::string& name, Vec3 centre, float radius, int steps) {
  std::vector<ProfilePoint> profile;
  for (int i = 0; i <= steps; ++i) {
    const float a = pi * (static_cast<float>(i) / static_cast<float>(steps) - 0.5f);
    const Vec2 n = {i == 0 || i == steps ? 0.f : std::cos(a), std::sin(a)};
    profile.push_back({radius * n, n});
  }
  Mesh mesh = turn(name, profile, 2 * steps);
  for (Vec3& p : mesh.position) p += centre;
  return finished(std::move(mesh));
}

Mesh make_quad(const std::string& name, Vec3 corner, Vec3 edge_u, Vec3 edge_v) {
  Mesh mesh = named(name);
  mesh.position = {corner, corner + edge_u, corner + edge_u + edge_v, corner + edge_v};
  mesh.uv = {{0.f, 0.f}, {1.f, 0.f}, {1.f, 1.f}, {0.f, 1.f}};
  mesh.triangles = {{{0, 1, 2}}, {{0, 2, 3}}};
  return finished(std::move(mesh));
}

Mesh make_quad_light(const std::string& name, Vec3 corner, Vec3 edge_u, Vec3 edge_v,
                     Vec3 radiance) {
  Mesh mesh = make_quad(name, corner, edge_u, edge_v);
  mesh.light_radiance = radiance;
  return mesh;
}

Scene make_builtin_scene() {
  Scene scene;
  // The ball rests on the rim of the dish, whose radius is 0.55 at height 0.42.
  const float height = 0.42f + std::sqrt(1.f - 0.55f * 0.55f);
  scene.meshes.push_back(make_sphere("ball", {0.f, height, 0.f}, 1.f, 96));
  scene.meshes.push_back(finished(turn("base", pedestal(), 192)));
  scene.meshes.back().is_stage = true;
  scene.meshes.push_back(
      make_quad("ground", {-10.f, 0.f, 10.f}, {20.f, 0.f, 0.f}, {0.f, 0.f, -20.f}));
  scene.meshes.back().is_stage = true;
  const Vec3 middle = {0.f, 1.1f, 0.f}, lamp = {-2.8f, 4.6f, 2.6f};
  const Vec3 towards = normalize(middle - lamp);
  const Vec3 edge_u = 1.6f * normalize(cross({0.f, 1.f, 0.f}, towards));
  const Vec3 edge_v = cross(towards, edge_u);
  scene.meshes.push_back(
      make_quad_light("key", lamp - 0.5f * (edge_u + edge_v), edge_u, edge_v, {38.f, 36.f, 33.f}));
  scene.cameras.push_back({"camera", look_at({2.4f, 2.5f, 4.6f}, middle, 0.62f)});
  return scene;
}

Mesh make_ground_below(const Scene& scene) {
  const Bounds box = bounds(scene);
  const Vec3 size = box.high - box.low;
  const float half = 5.f * std::max(size.x, std::max(size.y, size.z));
  const Vec3 centre = 0.5f * (box.low + box.high);
  Mesh ground = make_quad("ground", {centre.x - half, box.low.y, centre.z + half},
                          {2.f * half, 0.f, 0.f}, {0.f, 0.f, -2.f * half});
  ground.is_stage = true;
  return ground;
}

}  // namespace nacre::host
