#include "examples/render/surface.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "examples/render/mesh.h"

namespace nacre::host {

namespace {

Vec3 mix(Vec3 a, Vec3 b, float f) { return (1.f - f) * a + f * b; }

Tangent mix(const Tangent& a, const Tangent& b, float f) {
  return {mix(a.direction, b.direction, f), a.sign};
}

/// A vertex array at a point of a triangle.
template <class T>
T interpolate(const std::vector<T>& values, const Triangle& t, float u, float v) {
  return (1.f - u - v) * values[t.v[0]] + u * values[t.v[1]] + v * values[t.v[2]];
}

/// A vertex of a mesh that may bend, at a time of the shutter: Embree's formula.
template <class T>
T vertex(const Mesh& mesh, std::vector<T> Mesh::* still, std::vector<T> MeshPose::* posed,
         std::uint32_t v, float time) {
  if (mesh.poses.empty()) return (mesh.*still)[v];
  const auto steps = static_cast<float>(mesh.poses.size());
  const float whole = std::clamp(std::floor(time * steps), 0.f, steps - 1.f);
  const auto i = static_cast<std::size_t>(whole);
  const T& a = i == 0 ? (mesh.*still)[v] : (mesh.poses[i - 1].*posed)[v];
  const T& b = (mesh.poses[i].*posed)[v];
  return mix(a, b, time * steps - whole);
}

Vec3 position(const Mesh& mesh, std::uint32_t v, float time) {
  return vertex(mesh, &Mesh::position, &MeshPose::position, v, time);
}

Vec3 normal(const Mesh& mesh, std::uint32_t v, float time) {
  return vertex(mesh, &Mesh::normal, &MeshPose::normal, v, time);
}

Tangent tangent(const Mesh& mesh, std::uint32_t v, float time) {
  return vertex(mesh, &Mesh::tangent, &MeshPose::tangent, v, time);
}

Vec3 shading_normal(const Mesh& mesh, const Triangle& t, const SurfacePoint& p, Vec3 ng) {
  if (mesh.is_fibres()) return p.normal;
  if (mesh.normal.empty()) return ng;
  const Vec3 n = (1.f - p.u - p.v) * normal(mesh, t.v[0], p.time) +
                 p.u * normal(mesh, t.v[1], p.time) + p.v * normal(mesh, t.v[2], p.time);
  return normalize_or(n, ng);
}

Vec3 own_normal(const Mesh& mesh, const Triangle& t, const SurfacePoint& p) {
  if (mesh.is_fibres()) return p.normal;
  const Vec3 a = position(mesh, t.v[0], p.time);
  const Vec3 across = cross(position(mesh, t.v[1], p.time) - a, position(mesh, t.v[2], p.time) - a);
  // What bends may have no area for a moment.
  return mesh.poses.empty() ? normalize(across) : normalize_or(across, {0.f, 0.f, 1.f});
}

Vec3 own_position(const Mesh& mesh, const Triangle& t, const SurfacePoint& p) {
  if (mesh.is_fibres()) return fibre_point(mesh, t, p.u, p.normal).position();
  return (1.f - p.u - p.v) * position(mesh, t.v[0], p.time) + p.u * position(mesh, t.v[1], p.time) +
         p.v * position(mesh, t.v[2], p.time);
}

Vec3 normal_to_world(const Affine& to_object, Vec3 n, Vec3 otherwise) {
  const Vec3 world = normalize_or(transform_normal(to_object, n), otherwise);
  return is_finite(world) ? world : otherwise;
}

/// n, and mirrored at the plane across the view where it turns away from a viewer who sees the
/// surface, as at the outline of what a few triangles stand for: shaders would take the viewer for
/// one on the other side.
Vec3 facing(Vec3 n, Vec3 ng, Vec3 wo) {
  const float seen = dot(n, wo);
  const bool away = seen * dot(ng, wo) < 0.f && dot(n, ng) > 0.f;
  return away ? n - 2.f * seen * wo : n;
}

/// The uv shift that moves P by d, in the least-squares sense.
Vec2 to_uv(Vec3 dPdu, Vec3 dPdv, Vec3 d) {
  const float uu = dot(dPdu, dPdu), uv = dot(dPdu, dPdv), vv = dot(dPdv, dPdv);
  const float scale = 1.f / (uu * vv - uv * uv);
  const float u = dot(dPdu, d), v = dot(dPdv, d);
  const Vec2 shift = {scale * (vv * u - uv * v), scale * (uu * v - uv * u)};
  return std::isfinite(shift.x) && std::isfinite(shift.y) ? shift : Vec2{};
}

/// Footprint of a cone of diameter `width` along -wo on the plane of ng: across
/// the plane of incidence it keeps its width, along it is drawn out, at most tenfold.
void cone_footprint(Vec3 wo, float width, Vec3 ng, Vec3& dPdx, Vec3& dPdy) {
  const float cosine = std::max(std::abs(dot(wo, ng)), 0.1f);
  const Vec3 across = normalize_or(cross(ng, wo), perpendicular(ng));
  dPdx = width * across;
  dPdy = (width / cosine) * cross(ng, across);
}

/// Entry 4 i + k as MatrixLanes has it.
float entry(const Affine& m, int number) {
  const Vec3* rows[4] = {&m.x, &m.y, &m.z, &m.origin};
  const Vec3& row = *rows[number / 4];
  switch (number % 4) {
    case 0: return row.x;
    case 1: return row.y;
    case 2: return row.z;
    default: return number == 15 ? 1.f : 0.f;
  }
}

const Primvar* find_primvar(const Mesh& mesh, const std::string& name) {
  const auto found = std::ranges::find(mesh.primvars, name, &Primvar::name);
  return found != mesh.primvars.end() ? &*found : nullptr;
}

/// One that the attribute lacks is 0, but 1 for the fourth of a colour.
float component(const Primvar& primvar, std::size_t c, const std::uint32_t* v,
                const SurfacePoint& p) {
  const auto stride = static_cast<std::size_t>(primvar.components);
  if (c >= stride) return c == 3 ? 1.f : 0.f;
  return (1.f - p.u - p.v) * primvar.values[v[0] * stride + c] +
         p.u * primvar.values[v[1] * stride + c] + p.v * primvar.values[v[2] * stride + c];
}

}  // namespace

Vec3 surface_position(const Scene& scene, const SurfacePoint& p) {
  const Mesh& mesh = scene.meshes[p.mesh];
  const Vec3 own = own_position(mesh, mesh.triangles[p.triangle], p);
  return mesh.instances.empty() ? own : transform_point(mesh.instances[p.instance].at(p.time), own);
}

Vec3 surface_normal(const Scene& scene, const SurfacePoint& p) {
  const Mesh& mesh = scene.meshes[p.mesh];
  const Vec3 own = own_normal(mesh, mesh.triangles[p.triangle], p);
  if (mesh.instances.empty()) return own;
  return normal_to_world(inverse(mesh.instances[p.instance].at(p.time)), own, own);
}

SurfaceGeometry::SurfaceGeometry(const Scene& scene, const Clock& clock)
    : scene_(scene), clock_(clock) {
  for (const Mesh& mesh : scene.meshes) {
    has_instances_ = has_instances_ || !mesh.instances.empty();
    has_fibres_ = has_fibres_ || mesh.is_fibres();
    baked_.push_back({mesh.object_to_world, inverse(mesh.object_to_world)});
  }
}

/// Of the points of instances; those of the others are known.
void SurfaceGeometry::find_poses(std::span<const SurfacePoint> points, BatchBuffer& buffer) const {
  buffer.poses.resize(buffer.capacity());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SurfacePoint& p = points[i];
    const Mesh& mesh = scene_.meshes[p.mesh];
    if (mesh.instances.empty()) continue;
    const Affine to_world = mesh.instances[p.instance].at(p.time);
    buffer.poses[i] = {to_world, inverse(to_world), determinant(to_world) < 0.f};
  }
}

/// And where light that goes straight through each comes out.
void SurfaceGeometry::find_fibres(std::span<const SurfacePoint> points, BatchBuffer& buffer) const {
  buffer.fibres.resize(buffer.capacity());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SurfacePoint& p = points[i];
    const Mesh& mesh = scene_.meshes[p.mesh];
    Vec3 way;
    if (mesh.is_fibres()) {
      FibrePoint& at = buffer.fibres[i];
      at = fibre_point(mesh, mesh.triangles[p.triangle], p.u, p.normal);
      way = at.opposite() - at.position();
      if (!mesh.instances.empty()) way = transform_vector(pose(p, i, buffer).to_world, way);
    }
    store(buffer.through, i, way);
  }
}

const Pose& SurfaceGeometry::pose(const SurfacePoint& p, std::size_t i,
                                  const BatchBuffer& buffer) const {
  return scene_.meshes[p.mesh].instances.empty() ? baked_[p.mesh] : buffer.poses[i];
}

void SurfaceGeometry::fill(std::span<const SurfacePoint> points, const Capabilities& needs,
                           const PixelCamera& camera, BatchBuffer& buffer) const {
  assert(points.size() <= buffer.capacity());
  buffer.batch.count = static_cast<std::uint32_t>(points.size());
  if (points.empty()) return;
  const std::uint32_t wanted = needs.attributes;
  const bool object_space = (wanted & attribute_object_space) != 0;
  if (has_instances_) find_poses(points, buffer);
  if (has_fibres_) find_fibres(points, buffer);
  fill_position(points, object_space, buffer);
  if ((wanted & attribute_tangents) != 0) fill_tangents(points, object_space, buffer);
  constexpr std::uint32_t derivatives =
      attribute_surface_derivatives | attribute_footprint_position | attribute_footprint_uv;
  if ((wanted & derivatives) != 0) fill_derivatives(points, wanted, camera, buffer);
  if ((wanted & attribute_time) != 0) fill_times(points, buffer);
  if (needs.matrix_entries != 0) fill_matrices(points, needs.matrix_entries, buffer);
  fill_primvars(points, needs, buffer);
}

void SurfaceGeometry::fill_within(std::span<const InnerPoint> points, const Capabilities& needs,
                                  const PixelCamera& camera, BatchBuffer& buffer) const {
  // As on some triangle of the mesh, but for where they are.
  std::vector<SurfacePoint> on_surface;
  on_surface.reserve(points.size());
  for (const InnerPoint& p : points) {
    on_surface.push_back({.mesh = p.mesh, .wo = p.wo, .instance = p.instance, .time = p.time});
  }
  fill(on_surface, needs, camera, buffer);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Pose& pose = this->pose(on_surface[i], i, buffer);
    store(buffer.batch.P, i, points[i].P);
    store(buffer.batch.P_object, i, transform_point(pose.to_object, points[i].P));
    store(buffer.batch.uv, i, Vec2{});
  }
}

/// Nobody waits for each by itself.
void SurfaceGeometry::fetch_triangles(std::span<const SurfacePoint> points) const {
  for (const SurfacePoint& p : points) {
    __builtin_prefetch(&scene_.meshes[p.mesh].triangles[p.triangle]);
  }
  for (const SurfacePoint& p : points) {
    const Mesh& mesh = scene_.meshes[p.mesh];
    for (const std::uint32_t v : mesh.triangles[p.triangle].v) {
      __builtin_prefetch(&mesh.position[v]);
      if (!mesh.normal.empty()) __builtin_prefetch(&mesh.normal[v]);
    }
  }
}

void SurfaceGeometry::fill_position(std::span<const SurfacePoint> points, bool object_space,
                                    BatchBuffer& buffer) const {
  ShadingBatch& b = buffer.batch;
  fetch_triangles(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SurfacePoint& p = points[i];
    const Mesh& mesh = scene_.meshes[p.mesh];
    const Triangle& t = mesh.triangles[p.triangle];
    Vec3 ng = own_normal(mesh, t, p);
    Vec3 n = shading_normal(mesh, t, p, ng);
    const Vec3 own = mesh.is_fibres() ? buffer.fibres[i].position() : own_position(mesh, t, p);
    Vec3 place = own;
    const Pose& pose = this->pose(p, i, buffer);
    if (!mesh.instances.empty()) {
      ng = normal_to_world(pose.to_object, ng, ng);
      n = normal_to_world(pose.to_object, n, ng);
      place = transform_point(pose.to_world, place);
    }
    if (!p.keeps_normal) n = facing(n, ng, p.wo);
    store(b.P, i, place);
    store(b.N, i, n);
    store(b.Ng, i, ng);
    store(b.wo, i, p.wo);
    store(b.uv, i, mesh.uv.empty() ? Vec2{} : interpolate(mesh.uv, t, p.u, p.v));
    buffer.geometry_id[i] = p.mesh;
    buffer.primitive_id[i] = p.triangle;
    if (!object_space) continue;
    store(b.P_object, i,
          mesh.position_object.empty() ? own : interpolate(mesh.position_object, t, p.u, p.v));
    store(b.N_object, i, normalize_or(transform_normal(pose.to_world, n), n));
  }
}

void SurfaceGeometry::fill_tangents(std::span<const SurfacePoint> points, bool object_space,
                                    BatchBuffer& buffer) const {
  ShadingBatch& b = buffer.batch;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SurfacePoint& p = points[i];
    const Mesh& mesh = scene_.meshes[p.mesh];
    const Triangle& t = mesh.triangles[p.triangle];
    const Vec3 n = load(b.N, i);
    Tangent own;
    if (mesh.is_fibres()) {
      own = {buffer.fibres[i].axis, 1.f};
    } else if (mesh.tangent.empty()) {
      own = face_tangent(mesh, t, own_normal(mesh, t, p));
    } else {
      const Tangent a = tangent(mesh, t.v[0], p.time);
      own = {(1.f - p.u - p.v) * a.direction + p.u * tangent(mesh, t.v[1], p.time).direction +
                 p.v * tangent(mesh, t.v[2], p.time).direction,
             a.sign};
    }
    Vec3 raw = own.direction;
    const Pose& pose = this->pose(p, i, buffer);
    if (!mesh.instances.empty()) raw = transform_vector(pose.to_world, raw);
    const float sign = pose.mirrors ? -own.sign : own.sign;
    const Vec3 along = normalize_or(raw - dot(n, raw) * n, perpendicular(n));
    const Vec3 across = sign * cross(n, along);
    store(b.T, i, along);
    store(b.B, i, across);
    if (!object_space) continue;
    const Affine& to_object = pose.to_object;
    store(b.T_object, i, normalize_or(transform_vector(to_object, along), along));
    store(b.B_object, i, normalize_or(transform_vector(to_object, across), across));
  }
}

void SurfaceGeometry::fill_derivatives(std::span<const SurfacePoint> points,
                                       std::uint32_t attributes, const PixelCamera& camera,
                                       BatchBuffer& buffer) const {
  ShadingBatch& b = buffer.batch;
  const bool object_space = (attributes & attribute_object_space) != 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SurfacePoint& p = points[i];
    const Mesh& mesh = scene_.meshes[p.mesh];
    const Vec3 ng = load(b.Ng, i);
    Vec3 dPdu, dPdv, dPdx, dPdy;
    const bool has_uv = surface_derivatives(mesh, mesh.triangles[p.triangle], dPdu, dPdv);
    const Pose& pose = this->pose(p, i, buffer);
    if (!mesh.instances.empty()) {
      dPdu = transform_vector(pose.to_world, dPdu);
      dPdv = transform_vector(pose.to_world, dPdv);
    }
    if (p.from_camera) {
      camera.footprint(-p.wo, p.distance, ng, p.time, dPdx, dPdy);
    } else {
      cone_footprint(p.wo, p.width, ng, dPdx, dPdy);
    }
    store(b.dUVdx, i, has_uv ? to_uv(dPdu, dPdv, dPdx) : Vec2{});
    store(b.dUVdy, i, has_uv ? to_uv(dPdu, dPdv, dPdy) : Vec2{});
    if (!has_uv) {  // without a map, any frame of the plane
      dPdu = perpendicular(ng);
      dPdv = cross(ng, dPdu);
    }
    store(b.dPdu, i, dPdu);
    store(b.dPdv, i, dPdv);
    store(b.dPdx, i, dPdx);
    store(b.dPdy, i, dPdy);
    if (!object_space) continue;
    store(b.dPdx_object, i, transform_vector(pose.to_object, dPdx));
    store(b.dPdy_object, i, transform_vector(pose.to_object, dPdy));
  }
}

void SurfaceGeometry::fill_primvars(std::span<const SurfacePoint> points, const Capabilities& needs,
                                    BatchBuffer& buffer) const {
  buffer.batch.primvars = needs.primvars.empty() ? nullptr : buffer.primvars.data();
  for (std::size_t k = 0; k < needs.primvars.size(); ++k) {
    const PrimvarRequest& request = needs.primvars[k];
    PrimvarLanes& lanes = buffer.primvars[k];
    const auto components = static_cast<std::size_t>(std::min(request.components, 4));
    std::uint32_t last = ~0u;  // The mesh that `values` are of.
    const Primvar* values = nullptr;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const SurfacePoint& p = points[i];
      const Mesh& mesh = scene_.meshes[p.mesh];
      if (std::exchange(last, p.mesh) != p.mesh) values = find_primvar(mesh, request.name);
      lanes.present[i] = values != nullptr ? 1 : 0;
      const std::uint32_t* v = mesh.triangles[p.triangle].v;
      for (std::size_t c = 0; c < components; ++c) {
        lanes.component[c][i] = values != nullptr ? component(*values, c, v, p) : 0.f;
      }
    }
  }
}

void SurfaceGeometry::fill_times(std::span<const SurfacePoint> points, BatchBuffer& buffer) const {
  for (std::size_t i = 0; i < points.size(); ++i) {
    buffer.batch.times[i] = clock_.time_at(points[i].time);
    buffer.batch.frames[i] = clock_.frame_at(points[i].time);
  }
}

/// A lane for each entry that a kernel reads, written once and read in place by every kernel of
/// the material. A table by mesh, from which the library picks (ElementOf::instance), would be
/// picked from and copied for each of those calls; and what moves has a matrix for each point.
void SurfaceGeometry::fill_matrices(std::span<const SurfacePoint> points, std::uint32_t entries,
                                    BatchBuffer& buffer) const {
  ShadingBatch& b = buffer.batch;
  for (int number = 0; number < 32; ++number) {
    if ((entries >> number & 1u) == 0) continue;
    const bool to_world = number < 16;
    float* lane = (to_world ? b.object_to_world : b.world_to_object)[number % 16];
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Pose& pose = this->pose(points[i], i, buffer);
      lane[i] = entry(to_world ? pose.to_world : pose.to_object, number % 16);
    }
  }
}

}  // namespace nacre::host
