#include "examples/render/surface.h"

#include <cassert>

#include "examples/render/mesh.h"

namespace nacre::host {

namespace {

/// A vertex array at a point of a triangle.
template <class T>
T interpolate(const std::vector<T>& values, const Triangle& t, float u, float v) {
  return (1.f - u - v) * values[t.v[0]] + u * values[t.v[1]] + v * values[t.v[2]];
}

Vec3 shading_normal(const Mesh& mesh, const Triangle& t, const SurfacePoint& p, Vec3 ng) {
  return normalize_or(interpolate(mesh.normal, t, p.u, p.v), ng);
}

Vec3 face_normal(const Mesh& mesh, const Triangle& t) {
  const Vec3 a = mesh.position[t.v[0]];
  return normalize(cross(mesh.position[t.v[1]] - a, mesh.position[t.v[2]] - a));
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

void write_rows(const Affine& m, float* rows) {
  const float values[16] = {m.x.x, m.y.x, m.z.x, m.origin.x, m.x.y, m.y.y, m.z.y, m.origin.y,
                            m.x.z, m.y.z, m.z.z, m.origin.z, 0.f,   0.f,   0.f,   1.f};
  std::copy(values, values + 16, rows);
}

}  // namespace

Vec3 surface_position(const Mesh& mesh, std::uint32_t triangle, float u, float v) {
  return interpolate(mesh.position, mesh.triangles[triangle], u, v);
}

Vec3 surface_normal(const Mesh& mesh, std::uint32_t triangle) {
  return face_normal(mesh, mesh.triangles[triangle]);
}

SurfaceGeometry::SurfaceGeometry(const Scene& scene) : scene_(scene) {
  for (const Mesh& mesh : scene.meshes) world_to_object_.push_back(inverse(mesh.object_to_world));
}

void SurfaceGeometry::fill(std::span<const SurfacePoint> points, const Capabilities& needs,
                           const PixelCamera& camera, BatchBuffer& buffer) const {
  assert(points.size() <= buffer.capacity());
  buffer.batch.count = static_cast<std::uint32_t>(points.size());
  if (points.empty()) return;
  const std::uint32_t wanted = needs.attributes;
  const bool object_space = (wanted & attribute_object_space) != 0;
  fill_position(points, object_space, buffer);
  if ((wanted & attribute_tangents) != 0) fill_tangents(points, object_space, buffer);
  constexpr std::uint32_t derivatives =
      attribute_surface_derivatives | attribute_footprint_position | attribute_footprint_uv;
  if ((wanted & derivatives) != 0) fill_derivatives(points, wanted, camera, buffer);
  buffer.batch.object_to_world = buffer.batch.world_to_object = nullptr;
  if ((wanted & attribute_transform) != 0) fill_transform(points[0], buffer);
  fill_primvars(points, needs, buffer);
}

void SurfaceGeometry::fill_position(std::span<const SurfacePoint> points, bool object_space,
                                    BatchBuffer& buffer) const {
  ShadingBatch& b = buffer.batch;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SurfacePoint& p = points[i];
    const Mesh& mesh = scene_.meshes[p.mesh];
    const Triangle& t = mesh.triangles[p.triangle];
    const Vec3 ng = face_normal(mesh, t);
    const Vec3 n = shading_normal(mesh, t, p, ng);
    const Vec3 position = interpolate(mesh.position, t, p.u, p.v);
    store(b.P, i, position);
    store(b.N, i, n);
    store(b.Ng, i, ng);
    store(b.wo, i, p.wo);
    store(b.uv, i, mesh.uv.empty() ? Vec2{} : interpolate(mesh.uv, t, p.u, p.v));
    buffer.geometry_id[i] = p.mesh;
    buffer.primitive_id[i] = p.triangle;
    if (!object_space) continue;
    store(b.P_object, i,
          mesh.position_object.empty() ? position : interpolate(mesh.position_object, t, p.u, p.v));
    store(b.N_object, i, normalize_or(transform_normal(mesh.object_to_world, n), n));
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
    const Vec3 raw = (1.f - p.u - p.v) * mesh.tangent[t.v[0]].direction +
                     p.u * mesh.tangent[t.v[1]].direction + p.v * mesh.tangent[t.v[2]].direction;
    const Vec3 tangent = normalize_or(raw - dot(n, raw) * n, perpendicular(n));
    const Vec3 bitangent = mesh.tangent[t.v[0]].sign * cross(n, tangent);
    store(b.T, i, tangent);
    store(b.B, i, bitangent);
    if (!object_space) continue;
    const Affine& to_object = world_to_object_[p.mesh];
    store(b.T_object, i, normalize_or(transform_vector(to_object, tangent), tangent));
    store(b.B_object, i, normalize_or(transform_vector(to_object, bitangent), bitangent));
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
    if (p.from_camera) {
      camera.footprint(-p.wo, p.distance, ng, dPdx, dPdy);
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
    store(b.dPdx_object, i, transform_vector(world_to_object_[p.mesh], dPdx));
    store(b.dPdy_object, i, transform_vector(world_to_object_[p.mesh], dPdy));
  }
}

void SurfaceGeometry::fill_primvars(std::span<const SurfacePoint> points, const Capabilities& needs,
                                    BatchBuffer& buffer) const {
  buffer.batch.primvars = needs.primvars.empty() ? nullptr : buffer.primvars.data();
  const Mesh& mesh = scene_.meshes[points[0].mesh];
  for (std::size_t k = 0; k < needs.primvars.size(); ++k) {
    const PrimvarRequest& request = needs.primvars[k];
    PrimvarLanes& lanes = buffer.primvars[k];
    const auto found = std::find_if(mesh.primvars.begin(), mesh.primvars.end(),
                                    [&](const Primvar& p) { return p.name == request.name; });
    lanes.present = found != mesh.primvars.end();
    if (!lanes.present) continue;
    const auto stride = static_cast<std::size_t>(found->components);
    for (std::size_t c = 0; c < static_cast<std::size_t>(std::min(request.components, 4)); ++c) {
      const float absent = c == 3 ? 1.f : 0.f;
      for (std::size_t i = 0; i < points.size(); ++i) {
        const SurfacePoint& p = points[i];
        const std::uint32_t* v = mesh.triangles[p.triangle].v;
        lanes.component[c][i] = c >= stride ? absent
                                            : (1.f - p.u - p.v) * found->values[v[0] * stride + c] +
                                                  p.u * found->values[v[1] * stride + c] +
                                                  p.v * found->values[v[2] * stride + c];
      }
    }
  }
}

void SurfaceGeometry::fill_transform(const SurfacePoint& point, BatchBuffer& buffer) const {
  write_rows(scene_.meshes[point.mesh].object_to_world, buffer.object_to_world);
  write_rows(world_to_object_[point.mesh], buffer.world_to_object);
  buffer.batch.object_to_world = buffer.object_to_world;
  buffer.batch.world_to_object = buffer.world_to_object;
}

}  // namespace nacre::host
