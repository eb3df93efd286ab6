#include "examples/render/bvh.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <span>
#include <vector>

#include "examples/render/scene_limits.h"

namespace nacre::host {

namespace {

/// Rays per call; the packet lies on the stack.
constexpr std::size_t stream_size = 128;

RTCRay to_embree(const Ray& ray) {
  RTCRay r{};
  if (!is_traceable(ray)) {  // An interval that is empty.
    r.dir_z = 1.f;
    r.tfar = -INFINITY;
    return r;
  }
  r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
  r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
  r.tnear = 0.f;
  r.tfar = ray.far;
  r.mask = ray.kind;
  r.time = ray.time;
  return r;
}

/// Embree's filter for hits: camera rays pass through the backs of one-sided meshes.
void reject_backs(const RTCFilterFunctionNArguments* arguments) {
  const unsigned n = arguments->N;
  for (unsigned i = 0; i < n; ++i) {
    if (arguments->valid[i] == 0 || RTCRayN_mask(arguments->ray, n, i) != ray_camera) continue;
    const Vec3 ng = {RTCHitN_Ng_x(arguments->hit, n, i), RTCHitN_Ng_y(arguments->hit, n, i),
                     RTCHitN_Ng_z(arguments->hit, n, i)};
    const Vec3 direction = {RTCRayN_dir_x(arguments->ray, n, i),
                            RTCRayN_dir_y(arguments->ray, n, i),
                            RTCRayN_dir_z(arguments->ray, n, i)};
    if (dot(ng, direction) > 0.f) arguments->valid[i] = 0;
  }
}

/// Vertices are read sixteen bytes at a time: beyond the last one has to be something, or they are
/// copied.
bool set_vertices(RTCGeometry geometry, unsigned step, const std::vector<Vec3>& vertices) {
  if (vertices.capacity() > vertices.size()) {
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, step, RTC_FORMAT_FLOAT3,
                               vertices.data(), 0, sizeof(Vec3), vertices.size());
    return true;
  }
  void* copy = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, step, RTC_FORMAT_FLOAT3,
                                       sizeof(Vec3), vertices.size());
  if (copy != nullptr) std::memcpy(copy, vertices.data(), vertices.size() * sizeof(Vec3));
  return copy != nullptr;
}

bool add_triangles(RTCDevice device, RTCScene scene, const Mesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetGeometryTimeStepCount(geometry, static_cast<unsigned>(mesh.poses.size() + 1));
  bool ok = set_vertices(geometry, 0, mesh.position);
  for (unsigned i = 0; i < mesh.poses.size(); ++i) {
    ok = ok && set_vertices(geometry, i + 1, mesh.poses[i].position);
  }
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             mesh.triangles.data(), 0, sizeof(Triangle), mesh.triangles.size());
  if (ok) {
    rtcSetGeometryMask(geometry, mesh.visible_to);
    if (!mesh.two_sided) rtcSetGeometryIntersectFilterFunction(geometry, reject_backs);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
  }
  rtcReleaseGeometry(geometry);
  return ok;
}

/// Cones between spheres; where pieces follow each other Embree joins them.
bool add_fibres(RTCDevice device, RTCScene scene, const Mesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
  const std::size_t count = mesh.triangles.size();
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT4, 4 * sizeof(float),
                                                               mesh.position.size()));
  auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, sizeof(std::uint32_t), count));
  auto* flags = static_cast<std::uint8_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_FLAGS, 0, RTC_FORMAT_UCHAR, sizeof(std::uint8_t), count));
  const bool ok = vertices != nullptr && indices != nullptr && flags != nullptr;
  if (ok) {
    for (std::size_t i = 0; i < mesh.position.size(); ++i) {
      const Vec3 p = mesh.position[i];
      const float vertex[4] = {p.x, p.y, p.z, mesh.radius[i]};
      std::memcpy(vertices + 4 * i, vertex, sizeof vertex);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t first = mesh.triangles[i].v[0];
      const bool before = i > 0 && mesh.triangles[i - 1].v[1] == first;
      const bool behind = i + 1 < count && mesh.triangles[i + 1].v[0] == first + 1;
      indices[i] = first;
      flags[i] = static_cast<std::uint8_t>((before ? RTC_CURVE_FLAG_NEIGHBOR_LEFT : 0) |
                                           (behind ? RTC_CURVE_FLAG_NEIGHBOR_RIGHT : 0));
    }
    rtcSetGeometryMask(geometry, mesh.visible_to);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
  }
  rtcReleaseGeometry(geometry);
  return ok;
}

/// Watertight.
RTCSceneFlags scene_flags(std::size_t triangles) {
  return triangles > compact_triangles
             ? static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_COMPACT)
             : RTC_SCENE_FLAG_ROBUST;
}

std::size_t baked_triangles(const Scene& scene) {
  std::size_t sum = 0;
  for (const Mesh& mesh : scene.meshes) sum += mesh.instances.empty() ? mesh.triangles.size() : 0;
  return sum;
}

bool add_pieces(RTCDevice device, RTCScene scene, const Mesh& mesh) {
  return mesh.is_fibres() ? add_fibres(device, scene, mesh) : add_triangles(device, scene, mesh);
}

void add_instance(RTCDevice device, RTCScene scene, RTCScene shown, unsigned mask,
                  const Motion::Segment& segment) {
  static_assert(sizeof(Affine) == 12 * sizeof(float));
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, shown);
  rtcSetGeometryMask(geometry, mask);
  rtcSetGeometryTimeStepCount(geometry, static_cast<unsigned>(segment.steps.size()));
  // At other times it is not there.
  if (segment.steps.size() > 1) rtcSetGeometryTimeRange(geometry, segment.begin, segment.end);
  for (unsigned i = 0; i < segment.steps.size(); ++i) {
    rtcSetGeometryTransform(geometry, i, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &segment.steps[i]);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

}  // namespace

bool is_traceable(const Ray& ray) {
  const float squared = dot(ray.direction, ray.direction);
  return is_within_reach(ray.origin) && squared > 0.9f && squared < 1.1f && ray.far >= 0.f;
}

struct Bvh::Embree {
  /// What a geometry of `scene` shows. Embree numbers them as they come.
  struct Shown {
    std::uint32_t mesh, instance;
    bool is_fibre;
  };
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<RTCScene> instanced;  ///< One for each mesh with instances.
  std::vector<Shown> shown;
  bool ok = false;
  /// Where TBB gets no thread for building, Embree 3 leaves tasks that nobody waits for; to release
  /// such a scene ends the process, so it is left alone.
  bool is_half_built = false;

  ~Embree() {
    if (!is_half_built) {
      if (scene != nullptr) rtcReleaseScene(scene);
      for (RTCScene each : instanced) rtcReleaseScene(each);
    }
    if (device != nullptr) rtcReleaseDevice(device);
  }

  bool add(const Mesh& mesh, std::uint32_t number);
  void show(const Mesh& mesh, std::uint32_t number, RTCScene own);
  Hit hit(const RTCRayHit& of) const;
};

bool Bvh::Embree::add(const Mesh& mesh, std::uint32_t number) {
  if (mesh.instances.empty()) {
    shown.push_back({number, 0, mesh.is_fibres()});
    return add_pieces(device, scene, mesh);
  }
  RTCScene own = rtcNewScene(device);
  instanced.push_back(own);
  rtcSetSceneFlags(own, scene_flags(mesh.triangles.size()));
  if (!add_pieces(device, own, mesh)) return false;
  rtcCommitScene(own);
  show(mesh, number, own);
  return true;
}

void Bvh::Embree::show(const Mesh& mesh, std::uint32_t number, RTCScene own) {
  for (std::uint32_t i = 0; i < mesh.instances.size(); ++i) {
    const Motion& motion = mesh.instances[i];
    const Motion::Segment still{0.f, 1.f, {motion.still()}};
    const std::span<const Motion::Segment> segments =
        motion.is_still() ? std::span(&still, 1) : std::span(motion.segments());
    for (const Motion::Segment& segment : segments) {
      shown.push_back({number, i, mesh.is_fibres()});
      add_instance(device, scene, own, mesh.visible_to, segment);
    }
  }
}

Hit Bvh::Embree::hit(const RTCRayHit& of) const {
  const RTCHit& h = of.hit;
  if (h.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  const bool is_instance = h.instID[0] != RTC_INVALID_GEOMETRY_ID;
  const Shown& what = shown[is_instance ? h.instID[0] : h.geomID];
  if (!what.is_fibre) return {what.mesh, h.primID, h.u, h.v, of.ray.tfar, what.instance};
  const Vec3 normal = normalize({h.Ng_x, h.Ng_y, h.Ng_z});
  return {what.mesh, h.primID, std::clamp(h.u, 0.f, 1.f), 0.f, of.ray.tfar, what.instance, normal};
}

Bvh::Bvh(const Scene& scene, Diagnostics& diagnostics) : embree_(std::make_unique<Embree>()) {
  embree_->device = rtcNewDevice(nullptr);
  if (embree_->device != nullptr) {
    embree_->scene = rtcNewScene(embree_->device);
    rtcSetSceneFlags(embree_->scene, scene_flags(baked_triangles(scene)));
    const bool masks =
        rtcGetDeviceProperty(embree_->device, RTC_DEVICE_PROPERTY_RAY_MASK_SUPPORTED) != 0;
    const bool filters =
        rtcGetDeviceProperty(embree_->device, RTC_DEVICE_PROPERTY_FILTER_FUNCTION_SUPPORTED) != 0;
    bool ok = true;
    for (std::uint32_t i = 0; i < scene.meshes.size(); ++i) {
      const Mesh& mesh = scene.meshes[i];
      ok = ok && embree_->add(mesh, i);
      if (!filters && !mesh.two_sided) {
        diagnostics.warning("no-ray-filters", {}, "this Embree cannot hide the backs of meshes",
                            "one built with EMBREE_FILTER_FUNCTION", mesh.object_name);
      }
      if (!masks && mesh.visible_to != ray_any) {
        diagnostics.warning("no-ray-masks", {}, "this Embree cannot hide meshes from some rays",
                            "one built with EMBREE_RAY_MASK", mesh.object_name);
      }
    }
    embree_->is_half_built = ok;
    if (ok) rtcCommitScene(embree_->scene);
  }
  const RTCError error = rtcGetDeviceError(embree_->device);
  embree_->is_half_built = embree_->is_half_built && error != RTC_ERROR_NONE;
  embree_->ok = error == RTC_ERROR_NONE && embree_->device != nullptr;
  if (!embree_->ok) {
    diagnostics.error("bvh-failed", {}, "the acceleration structure could not be built", {},
                      fmt::format("Embree error {}", static_cast<int>(error)));
  }
}

Bvh::~Bvh() = default;

bool Bvh::ok() const { return embree_->ok; }

void Bvh::intersect(std::span<const Ray> rays, std::span<Hit> hits, bool coherent) const {
  assert(rays.size() == hits.size());
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags =
      coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  RTCRayHit stream[stream_size];
  for (std::size_t first = 0; first < rays.size(); first += stream_size) {
    const std::size_t count = std::min(stream_size, rays.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      stream[i].ray = to_embree(rays[first + i]);
      stream[i].hit.geomID = stream[i].hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect1M(embree_->scene, &context, stream, static_cast<unsigned>(count),
                   sizeof(RTCRayHit));
    for (std::size_t i = 0; i < count; ++i) hits[first + i] = embree_->hit(stream[i]);
  }
}

void Bvh::occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const {
  assert(rays.size() == blocked.size());
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay stream[stream_size];
  for (std::size_t first = 0; first < rays.size(); first += stream_size) {
    const std::size_t count = std::min(stream_size, rays.size() - first);
    for (std::size_t i = 0; i < count; ++i) stream[i] = to_embree(rays[first + i]);
    rtcOccluded1M(embree_->scene, &context, stream, static_cast<unsigned>(count), sizeof(RTCRay));
    // Embree sets tfar to minus infinity where it found something.
    for (std::size_t i = 0; i < count; ++i) {
      blocked[first + i] = stream[i].tfar < 0.f && is_traceable(rays[first + i]) ? 1 : 0;
    }
  }
}

}  // namespace nacre::host
