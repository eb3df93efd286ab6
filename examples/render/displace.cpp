#include "examples/render/displace.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "examples/render/mesh.h"
#include "examples/render/scene_limits.h"
#include "examples/render/tessellate.h"

namespace nacre::host {

namespace {

constexpr std::uint32_t batch_size = 1024;

/// Where the vertices of a mesh are in the world: for the instance next to the eye, as the shutter
/// opens.
struct Placed {
  Affine to_world;
  std::uint32_t instance = 0;
};

Placed nearest(const Mesh& mesh, Vec3 eye) {
  Placed best;
  if (mesh.instances.empty()) return best;
  const Bounds box = vertex_bounds(mesh);
  const Vec3 centre = 0.5f * (box.low + box.high);
  float least = INFINITY;
  for (std::uint32_t i = 0; i < mesh.instances.size(); ++i) {
    const Affine to_world = mesh.instances[i].at(0.f);
    const float distance = length(transform_point(to_world, centre) - eye);
    if (!(distance < least)) continue;
    least = distance;
    best = {to_world, i};
  }
  return best;
}

/// By vertex, the first one at its place.
std::vector<std::uint32_t> places(const Mesh& mesh) {
  const auto less = [&](std::uint32_t a, std::uint32_t b) {
    const Vec3 p = mesh.position[a], q = mesh.position[b];
    if (p.x != q.x) return p.x < q.x;
    if (p.y != q.y) return p.y < q.y;
    return p.z != q.z ? p.z < q.z : a < b;
  };
  std::vector<std::uint32_t> order(mesh.position.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, less);
  std::vector<std::uint32_t> first(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Vec3 p = mesh.position[order[i]];
    const bool is_same = i > 0 && is_zero(p - mesh.position[order[i - 1]]);
    first[order[i]] = is_same ? first[order[i - 1]] : order[i];
  }
  return first;
}

/// The mean over the vertices at each place, for all of them.
void average(std::vector<Vec3>& values, const std::vector<std::uint32_t>& places) {
  std::vector<Vec3> sum(values.size());
  std::vector<float> count(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum[places[i]] += values[i];
    count[places[i]] += 1.f;
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = (1.f / count[places[i]]) * sum[places[i]];
  }
}

class Displacer {
 public:
  Displacer(Scene& scene, const PixelCamera& camera, Vec3 eye, const DisplaceSettings& settings)
      : scene_(scene),
        camera_(camera),
        eye_(eye),
        settings_(settings),
        left_(settings.most_triangles) {}

  /// False where the mesh is coarser than asked.
  bool split(std::uint32_t number) {
    Mesh& mesh = scene_.meshes[number];
    const Placed placed = nearest(mesh, eye_);
    give_flat_vertices(mesh);
    const std::size_t before = mesh.triangles.size();
    const bool is_fine = tessellate(
        mesh,
        [&](Vec3 a, Vec3 b) {
          if (settings_.stop.stop_requested()) return false;
          const Vec3 p = transform_point(placed.to_world, a);
          const Vec3 q = transform_point(placed.to_world, b);
          return length(q - p) > edge_at(0.5f * (p + q));
        },
        before + left_);
    left_ -= mesh.triangles.size() - before;
    return is_fine;
  }

  /// Moves the vertices; how many stay because they went nowhere.
  std::size_t move(std::uint32_t number, const Shader& shader, const SurfaceGeometry& geometry) {
    Mesh& mesh = scene_.meshes[number];
    const Placed placed = nearest(mesh, eye_);
    std::vector<Vec3> offsets = ask(number, shader, geometry, placed);
    const Affine to_own = inverse(placed.to_world);
    std::size_t invalid = 0;
    for (std::size_t i = 0; i < offsets.size(); ++i) {
      const Vec3 offset = transform_vector(to_own, offsets[i]);
      const bool is_valid = is_finite(offset) && is_within_reach(mesh.position[i] + offset);
      offsets[i] = is_valid ? offset : Vec3{};
      invalid += is_valid ? 0 : 1;
    }
    const std::vector<std::uint32_t> together = places(mesh);
    average(offsets, together);
    if (mesh.position_object.empty()) mesh.position_object = mesh.position;
    for (std::size_t i = 0; i < offsets.size(); ++i) mesh.position[i] += offsets[i];
    renew_frames(mesh, together);
    return invalid;
  }

 private:
  /// Longest edge there, in the world.
  float edge_at(Vec3 p) const {
    return settings_.edge * camera_.sample_angle() * std::max(length(p - eye_), 1e-6f);
  }

  /// What the shader says for each vertex, in the world.
  std::vector<Vec3> ask(std::uint32_t number, const Shader& shader, const SurfaceGeometry& geometry,
                        const Placed& placed) const {
    const Mesh& mesh = scene_.meshes[number];
    // A vertex is a corner of the last triangle that has it.
    std::vector<SurfacePoint> corners(mesh.position.size(), {.mesh = number});
    std::vector<bool> is_used(mesh.position.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      for (int c = 0; c < 3; ++c) {
        const std::uint32_t v = mesh.triangles[t].v[c];
        corners[v].triangle = t;
        corners[v].u = c == 1 ? 1.f : 0.f;
        corners[v].v = c == 2 ? 1.f : 0.f;
        is_used[v] = true;
      }
    }
    std::vector<std::uint32_t> asked;
    for (std::uint32_t v = 0; v < corners.size(); ++v) {
      if (is_used[v]) asked.push_back(v);
    }
    const Capabilities needs = shader.capabilities();
    BatchBuffer buffer(batch_size, 0, needs.primvars.size());
    buffer.batch.time = settings_.clock.time;
    buffer.batch.frame = settings_.clock.frame;
    std::vector<Vec3> offsets(mesh.position.size());
    std::vector<SurfacePoint> points;
    for (std::size_t first = 0; first < asked.size(); first += batch_size) {
      if (settings_.stop.stop_requested()) break;
      const std::size_t count = std::min<std::size_t>(batch_size, asked.size() - first);
      points.clear();
      for (std::size_t i = first; i < first + count; ++i) {
        SurfacePoint& point = points.emplace_back(corners[asked[i]]);
        const Vec3 p = transform_point(placed.to_world, mesh.position[asked[i]]);
        point.wo = normalize_or(eye_ - p, {0.f, 0.f, 1.f});
        point.keeps_normal = true;
        point.width = edge_at(p);
        point.instance = placed.instance;
      }
      geometry.fill(points, needs, camera_, buffer);
      shader.displacement(buffer.batch, buffer.rgb);
      for (std::size_t i = 0; i < count; ++i) offsets[asked[first + i]] = load(buffer.rgb, i);
    }
    return offsets;
  }

  Scene& scene_;
  const PixelCamera& camera_;
  Vec3 eye_;
  const DisplaceSettings& settings_;
  std::size_t left_;  ///< Triangles that may come.
};

}  // namespace

DisplaceResult displace(Scene& scene, const std::vector<const Shader*>& shaders,
                        const PixelCamera& camera, Vec3 eye, const DisplaceSettings& settings) {
  DisplaceResult result;
  Displacer displacer(scene, camera, eye, settings);
  const auto moves = [&](std::uint32_t i) {
    return shaders[i] != nullptr && shaders[i]->capabilities().displaces &&
           !scene.meshes[i].is_fibres();
  };
  for (std::uint32_t i = 0; i < shaders.size(); ++i) {
    if (moves(i) && !scene.meshes[i].poses.empty()) {
      scene.meshes[i].poses.clear();
      result.stopped.push_back(i);
    }
    if (moves(i) && !displacer.split(i)) result.coarse.push_back(i);
  }
  const SurfaceGeometry geometry(scene, settings.clock);
  for (std::uint32_t i = 0; i < shaders.size(); ++i) {
    if (moves(i)) result.invalid += displacer.move(i, *shaders[i], geometry);
  }
  return result;
}

}  // namespace nacre::host
