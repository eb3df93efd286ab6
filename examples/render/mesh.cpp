#include "examples/render/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "examples/render/scene_limits.h"

namespace nacre::host {

namespace {

Vec3 face_cross(const Mesh& mesh, const Triangle& t) {
  const Vec3 a = mesh.position[t.v[0]];
  return cross(mesh.position[t.v[1]] - a, mesh.position[t.v[2]] - a);
}

bool is_usable(const Mesh& mesh, const Triangle& t) {
  for (const std::uint32_t v : t.v) {
    if (v >= mesh.position.size() || !is_within_reach(mesh.position[v])) return false;
  }
  for (const MeshPose& pose : mesh.poses) {
    for (const std::uint32_t v : t.v) {
      if (!is_within_reach(pose.position[v])) return false;
    }
  }
  const Vec3 c = face_cross(mesh, t);
  return is_finite(c) && (c.x != 0.f || c.y != 0.f || c.z != 0.f);
}

std::string called(const Mesh& mesh) {
  return mesh.object_name.empty() ? "a mesh" : '\'' + mesh.object_name + '\'';
}

void drop_unusable(Mesh& mesh, const SourceLocation& where, Diagnostics& diagnostics) {
  const std::size_t dropped =
      std::erase_if(mesh.triangles, [&](const Triangle& t) { return !is_usable(mesh, t); });
  if (dropped == 0) return;
  diagnostics.warning(
      "bad-triangles", where,
      fmt::format("{} triangles of {} cannot be traced and were left out", dropped, called(mesh)),
      fmt::format("corners that are there, at most {:g} from 0 and not in a line",
                  largest_coordinate));
}

float corner_angle(const Mesh& mesh, const Triangle& t, int corner) {
  const Vec3 p = mesh.position[t.v[corner]];
  const Vec3 a = normalize(mesh.position[t.v[(corner + 1) % 3]] - p);
  const Vec3 b = normalize(mesh.position[t.v[(corner + 2) % 3]] - p);
  return std::atan2(length(cross(a, b)), dot(a, b));
}

void make_normals(Mesh& mesh) {
  mesh.normal.assign(mesh.position.size(), {});
  for (const Triangle& t : mesh.triangles) {
    const Vec3 n = normalize_or(face_cross(mesh, t), {});
    for (int c = 0; c < 3; ++c) mesh.normal[t.v[c]] += corner_angle(mesh, t, c) * n;
  }
}

/// Gives each triangle vertices of its own, and them its normal.
void make_flat(Mesh& mesh) {
  std::vector<std::uint32_t> corners;
  corners.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) corners.insert(corners.end(), t.v, t.v + 3);
  mesh.normal.clear();
  take_order(mesh, corners);
  mesh.normal.reserve(mesh.position.size());
  std::uint32_t next = 0;
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& v : t.v) v = next++;
    mesh.normal.insert(mesh.normal.end(), 3, normalize(face_cross(mesh, t)));
  }
}

bool has_direction(Vec3 v) {
  const Vec3 unit = normalize_or(v, {});
  return is_finite(v) && dot(unit, unit) > 0.f;
}

/// Counts what the file gives and has no direction, of vertices that a triangle uses.
template <class Direction>
void report_directions(const Mesh& mesh, const char* code, const char* what,
                       const SourceLocation& where, Diagnostics& diagnostics, Direction direction) {
  std::vector<bool> bad(mesh.position.size());
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t.v) bad[v] = !has_direction(direction(v));
  }
  const auto count = std::count(bad.begin(), bad.end(), true);
  if (count == 0) return;
  diagnostics.warning(
      code, where,
      fmt::format("{} {} of {} have no direction and were replaced", count, what, called(mesh)),
      "finite vectors other than 0");
}

/// Unit normals; a vertex without one takes that of a triangle it belongs to.
void repair_normals(Mesh& mesh) {
  std::vector<Vec3> face(mesh.position.size(), {0.f, 0.f, 1.f});
  for (const Triangle& t : mesh.triangles) {
    const Vec3 n = normalize(face_cross(mesh, t));
    for (const std::uint32_t v : t.v) face[v] = n;
  }
  for (std::size_t i = 0; i < mesh.normal.size(); ++i) {
    mesh.normal[i] = normalize_or(is_finite(mesh.normal[i]) ? mesh.normal[i] : Vec3{}, face[i]);
  }
}

void agree_winding(Mesh& mesh) {
  for (Triangle& t : mesh.triangles) {
    const Vec3 n = mesh.normal[t.v[0]] + mesh.normal[t.v[1]] + mesh.normal[t.v[2]];
    if (dot(face_cross(mesh, t), n) < 0.f) std::swap(t.v[1], t.v[2]);
  }
}

Tangent orthogonal_tangent(Vec3 n, Vec3 along_u, Vec3 along_v) {
  const Vec3 t = normalize_or(along_u - dot(n, along_u) * n, perpendicular(n));
  return {t, dot(cross(n, t), along_v) < 0.f ? -1.f : 1.f};
}

/// Per vertex the angle-weighted mean of the triangles' dP/du and dP/dv
/// directions, made orthogonal to the normal: MikkTSpace (Mikkelsen 2008)
/// without its splitting of vertices where the uv map mirrors.
void make_tangents(Mesh& mesh) {
  std::vector<Vec3> along_u(mesh.position.size()), along_v(mesh.position.size());
  for (const Triangle& t : mesh.triangles) {
    Vec3 dPdu, dPdv;
    if (!surface_derivatives(mesh, t, dPdu, dPdv)) continue;
    for (int c = 0; c < 3; ++c) {
      const float weight = corner_angle(mesh, t, c);
      along_u[t.v[c]] += weight * normalize_or(dPdu, {});
      along_v[t.v[c]] += weight * normalize_or(dPdv, {});
    }
  }
  mesh.tangent.resize(mesh.position.size());
  for (std::size_t i = 0; i < mesh.tangent.size(); ++i) {
    mesh.tangent[i] = orthogonal_tangent(mesh.normal[i], along_u[i], along_v[i]);
  }
}

void repair_tangents(Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.tangent.size(); ++i) {
    Tangent& t = mesh.tangent[i];
    const Vec3 n = mesh.normal[i];
    t.direction = is_finite(t.direction) ? t.direction : Vec3{};
    t.direction = normalize_or(t.direction - dot(n, t.direction) * n, perpendicular(n));
    t.sign = t.sign < 0.f ? -1.f : 1.f;
  }
}

/// Calls `f` while the vertices are those of each pose.
template <class F>
void in_each_pose(Mesh& mesh, F f) {
  const auto exchange = [&mesh](MeshPose& pose) {
    std::swap(mesh.position, pose.position);
    std::swap(mesh.normal, pose.normal);
    std::swap(mesh.tangent, pose.tangent);
  };
  for (MeshPose& pose : mesh.poses) {
    exchange(pose);
    f();
    exchange(pose);
  }
}

/// Unit normals of triangles that have vertices of their own.
void make_flat_normals(Mesh& mesh) {
  mesh.normal.resize(mesh.position.size());
  for (const Triangle& t : mesh.triangles) {
    const Vec3 n = normalize_or(face_cross(mesh, t), {0.f, 0.f, 1.f});
    for (const std::uint32_t v : t.v) mesh.normal[v] = n;
  }
}

/// What the poses lack, as the mesh itself got it.
void finish_poses(Mesh& mesh, bool has_normals, bool has_tangents, MissingNormals missing) {
  in_each_pose(mesh, [&] {
    if (!has_normals && missing == MissingNormals::flat) make_flat_normals(mesh);
    if (!has_normals && missing == MissingNormals::smooth) make_normals(mesh);
    repair_normals(mesh);
    if (!has_tangents) make_tangents(mesh);
    repair_tangents(mesh);
  });
}

}  // namespace

bool finish_mesh(Mesh& mesh, const SourceLocation& where, Diagnostics& diagnostics,
                 MissingNormals missing) {
  drop_unusable(mesh, where, diagnostics);
  if (mesh.triangles.empty()) {
    diagnostics.error("empty-mesh", where, called(mesh) + " has no triangle",
                      "at least one triangle with an area");
    return false;
  }
  const bool has_normals = mesh.normal.size() == mesh.position.size();
  if (!has_normals && missing == MissingNormals::flat && mesh.poses.empty()) {
    mesh.normal.clear();
    mesh.tangent.clear();
    return true;
  }
  if (has_normals) {
    report_directions(mesh, "bad-normals", "normals", where, diagnostics,
                      [&](std::uint32_t v) { return mesh.normal[v]; });
  } else if (missing == MissingNormals::flat) {
    make_flat(mesh);
  } else {
    make_normals(mesh);
  }
  repair_normals(mesh);
  if (has_normals) agree_winding(mesh);
  const bool has_tangents = mesh.tangent.size() == mesh.position.size();
  if (has_tangents) {
    report_directions(mesh, "bad-tangents", "tangents", where, diagnostics,
                      [&](std::uint32_t v) { return mesh.tangent[v].direction; });
  } else {
    make_tangents(mesh);
  }
  repair_tangents(mesh);
  finish_poses(mesh, has_normals, has_tangents, missing);
  return true;
}

void give_flat_vertices(Mesh& mesh) {
  if (!mesh.normal.empty() || mesh.is_fibres()) return;
  make_flat(mesh);
  repair_normals(mesh);
  make_tangents(mesh);
  repair_tangents(mesh);
}

Tangent face_tangent(const Mesh& mesh, const Triangle& triangle, Vec3 n) {
  Vec3 dPdu, dPdv;
  surface_derivatives(mesh, triangle, dPdu, dPdv);
  return orthogonal_tangent(n, normalize_or(dPdu, {}), dPdv);
}

void renew_frames(Mesh& mesh, const std::vector<std::uint32_t>& places) {
  make_normals(mesh);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i] != i) mesh.normal[places[i]] += mesh.normal[i];
  }
  for (std::size_t i = 0; i < places.size(); ++i) mesh.normal[i] = mesh.normal[places[i]];
  repair_normals(mesh);
  make_tangents(mesh);
  repair_tangents(mesh);
}

void take_order(Mesh& mesh, const std::vector<std::uint32_t>& order) {
  mesh.position = gathered(mesh.position, order);
  mesh.position_object = gathered(mesh.position_object, order);
  mesh.normal = gathered(mesh.normal, order);
  mesh.tangent = gathered(mesh.tangent, order);
  for (MeshPose& pose : mesh.poses) {
    pose.position = gathered(pose.position, order);
    pose.normal = gathered(pose.normal, order);
    pose.tangent = gathered(pose.tangent, order);
  }
  mesh.uv = gathered(mesh.uv, order);
  for (Primvar& primvar : mesh.primvars) {
    primvar.values = gathered(primvar.values, order, static_cast<std::size_t>(primvar.components));
  }
}

namespace {

/// The vertices alone.
void transform(Mesh& mesh, const Affine& object_to_world) {
  const Affine world_to_object = inverse(object_to_world);
  for (Vec3& p : mesh.position) p = transform_point(object_to_world, p);
  for (Vec3& n : mesh.normal) n = normalize_or(transform_normal(world_to_object, n), {});
  const bool mirrors = determinant(object_to_world) < 0.f;
  for (Tangent& t : mesh.tangent) {
    t.direction = normalize_or(transform_vector(object_to_world, t.direction), {});
    if (mirrors) t.sign = -t.sign;
  }
}

}  // namespace

void bake_transform(Mesh& mesh, const Affine& object_to_world) {
  mesh.object_to_world = object_to_world;
  mesh.position_object = mesh.position;
  transform(mesh, object_to_world);
  in_each_pose(mesh, [&] { transform(mesh, object_to_world); });
  const float volume = determinant(object_to_world);
  for (float& r : mesh.radius) r *= std::cbrt(std::abs(volume));
  if (!(volume < 0.f)) return;
  for (Triangle& t : mesh.triangles) std::swap(t.v[1], t.v[2]);
}

bool surface_derivatives(const Mesh& mesh, const Triangle& triangle, Vec3& dPdu, Vec3& dPdv) {
  dPdu = dPdv = {};
  if (mesh.uv.empty()) return false;
  const std::uint32_t* v = triangle.v;
  const Vec3 e1 = mesh.position[v[1]] - mesh.position[v[0]];
  const Vec3 e2 = mesh.position[v[2]] - mesh.position[v[0]];
  const Vec2 d1 = mesh.uv[v[1]] - mesh.uv[v[0]];
  const Vec2 d2 = mesh.uv[v[2]] - mesh.uv[v[0]];
  const float area = d1.x * d2.y - d1.y * d2.x;
  const float scale = 1.f / area;
  if (area == 0.f || !std::isfinite(scale)) return false;
  dPdu = scale * (d2.y * e1 - d1.y * e2);
  dPdv = scale * (d1.x * e2 - d2.x * e1);
  if (is_finite(dPdu) && is_finite(dPdv)) return true;
  dPdu = dPdv = {};
  return false;
}

bool is_closed(const Mesh& mesh) {
  if (mesh.is_fibres()) return false;
  struct Edge {
    std::array<float, 6> ends;  ///< The lesser one first.
    int way;                    ///< 1 from there, -1 to there.
  };
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    for (int c = 0; c < 3; ++c) {
      const Vec3 p = mesh.position[t.v[c]], q = mesh.position[t.v[(c + 1) % 3]];
      const std::array<float, 6> forth{p.x, p.y, p.z, q.x, q.y, q.z};
      const std::array<float, 6> back{q.x, q.y, q.z, p.x, p.y, p.z};
      if (forth != back) edges.push_back(forth < back ? Edge{forth, 1} : Edge{back, -1});
    }
  }
  std::ranges::sort(edges, {}, &Edge::ends);
  for (std::size_t i = 0; i < edges.size();) {
    int sum = 0;
    const std::array<float, 6> ends = edges[i].ends;
    for (; i < edges.size() && edges[i].ends == ends; ++i) sum += edges[i].way;
    if (sum != 0) return false;
  }
  return true;
}

Bounds vertex_bounds(const Mesh& mesh) {
  Bounds box;
  for (const MeshPose& pose : mesh.poses) {
    for (const Triangle& t : mesh.triangles) {
      for (const std::uint32_t v : t.v) box.add(pose.position[v]);
    }
  }
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t.v) {
      const float r = mesh.is_fibres() ? mesh.radius[v] : 0.f;
      box.add(mesh.position[v] + Vec3{r, r, r});
      box.add(mesh.position[v] - Vec3{r, r, r});
    }
  }
  return box;
}

Bounds instance_bounds(const Bounds& own, const Motion& motion) {
  Bounds box;
  for_each_step(motion, [&](const Affine& map) {
    for (int corner = 0; corner < 8; ++corner) {
      box.add(transform_point(
          map, {corner & 1 ? own.high.x : own.low.x, corner & 2 ? own.high.y : own.low.y,
                corner & 4 ? own.high.z : own.low.z}));
    }
  });
  return box;
}

Bounds bounds(const Scene& scene) {
  Bounds box;
  for (const Mesh& mesh : scene.meshes) {
    if (mesh.light_radiance) continue;
    const Bounds own = vertex_bounds(mesh);
    if (own.empty()) continue;
    if (mesh.instances.empty()) {
      box.add(own.low);
      box.add(own.high);
    }
    for (const Motion& motion : mesh.instances) {
      const Bounds moved = instance_bounds(own, motion);
      box.add(moved.low);
      box.add(moved.high);
    }
  }
  return box;
}

}  // namespace nacre::host
