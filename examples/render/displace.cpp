#include "examples/render/displace.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "examples/render/mesh.h"
#include "examples/render/offset_grid.h"
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

  /// By what shaders are known to do: where they move all there is away from the eye it is split
  /// less. False where the mesh is coarser than asked.
  bool split(std::uint32_t number, const Shader& shader, const SurfaceGeometry& geometry) {
    const Placed placed = nearest(scene_.meshes[number], eye_);
    if (known_.size() <= number) known_.resize(number + 1);
    known_[number] = known_offsets(number, shader, geometry, placed);
    return split(number, placed, [&](Vec3 own, Vec3 p, float) {
      const Bounds& box = known_[number]->at(own);
      const float stays = length(p - eye_);
      return box.empty() ? stays : std::max(stays, distance_to_moved(eye_, p, box));
    });
  }

  /// The same by what they do at its vertices. Where the box that is known is not much larger it is
  /// taken, which is sure; else it says little of where the surface is.
  bool refine(std::uint32_t number, const std::vector<Vec3>& offsets) {
    const Mesh& mesh = scene_.meshes[number];
    OffsetGrid seen(vertex_bounds(mesh));
    for (const Triangle& t : mesh.triangles) {
      Bounds places, moves;
      for (const std::uint32_t v : t.v) {
        if (!is_finite(offsets[v])) continue;
        places.add(mesh.position[v]), moves.add(offsets[v]);
      }
      if (!moves.empty()) seen.add(places, moves);
    }
    return split(number, nearest(mesh, eye_), [&](Vec3 own, Vec3 p, float half) {
      const Bounds &met = seen.at(own), &known = known_[number]->at(own);
      const float stays = length(p - eye_);
      if (met.empty()) return stays;
      if (!may_be_seen(p, half, met, known)) return stays;
      const bool is_tight = !known.empty() && length(known.high - known.low) <
                                                  2.f * length(met.high - met.low) + 1e-3f * stays;
      const float moved = distance_to_moved(eye_, p, is_tight ? known : met);
      return std::max(moved, stays / most_times_finer);
    });
  }

  /// Moves the vertices; how many stay because they went nowhere.
  std::size_t move(std::uint32_t number, std::vector<Vec3> offsets) {
    Mesh& mesh = scene_.meshes[number];
    const Placed placed = nearest(mesh, eye_);
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

  /// What the shader says for each vertex, in the world.
  std::vector<Vec3> ask(std::uint32_t number, const Shader& shader,
                        const SurfaceGeometry& geometry) const {
    const Mesh& mesh = scene_.meshes[number];
    const Placed placed = nearest(mesh, eye_);
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
        point.width = edge_at(length(p - eye_));
        point.instance = placed.instance;
      }
      geometry.fill(points, needs, camera_, buffer);
      shader.displacement(buffer.batch, buffer.rgb);
      for (std::size_t i = 0; i < count; ++i) offsets[asked[first + i]] = load(buffer.rgb, i);
    }
    return offsets;
  }

 private:
  /// A surface that comes to the eye is split no more often, times two each, than one that stays:
  /// next to the eye itself there would be no end.
  static constexpr float most_times_finer = 8.f;

  /// Whether the picture has anything of what is so near to a place, and moved by what is in either
  /// box. (A box is infinite where nothing is known.)
  bool may_be_seen(Vec3 p, float near, const Bounds& met, const Bounds& known) const {
    const auto sees = [&](const Bounds& box) {
      const Vec3 size = box.high - box.low;
      return !is_finite(size) ||
             camera_.may_see(p + 0.5f * (box.low + box.high), near + 0.5f * length(size));
    };
    const bool is_known = !known.empty() && is_finite(known.high - known.low);
    return sees(is_known ? known : met);
  }

  /// Longest edge so far away, in the world.
  float edge_at(float distance) const {
    return settings_.edge * camera_.sample_angle() * std::max(distance, 1e-6f);
  }

  /// `distance`: from the eye, of what is at a place of the mesh and of the world, and so far about
  /// it.
  template <class F>
  bool split(std::uint32_t number, const Placed& placed, F&& distance) {
    Mesh& mesh = scene_.meshes[number];
    const std::size_t before = mesh.triangles.size();
    const bool is_fine = tessellate(
        mesh,
        [&](Vec3 a, Vec3 b) {
          if (settings_.stop.stop_requested()) return false;
          const Vec3 p = transform_point(placed.to_world, a);
          const Vec3 q = transform_point(placed.to_world, b);
          const float edge = length(q - p);
          return edge > edge_at(distance(0.5f * (a + b), 0.5f * (p + q), 0.5f * edge));
        },
        before + left_);
    left_ -= mesh.triangles.size() - before;
    return is_fine;
  }

  /// What is known before anything is split: by triangles, some together where there are many.
  OffsetGrid known_offsets(std::uint32_t number, const Shader& shader,
                           const SurfaceGeometry& geometry, const Placed& placed) const {
    constexpr std::size_t most_asked = 4096;
    const Mesh& mesh = scene_.meshes[number];
    OffsetGrid known(vertex_bounds(mesh));
    const std::size_t together =
        std::clamp<std::size_t>(mesh.triangles.size() / most_asked, 1, batch_size / 3);
    const Capabilities needs = shader.capabilities();
    BatchBuffer buffer(batch_size, 0, needs.primvars.size());
    std::vector<SurfacePoint> corners;
    for (std::size_t first = 0; first < mesh.triangles.size(); first += together) {
      if (settings_.stop.stop_requested()) break;
      const std::size_t end = std::min(first + together, mesh.triangles.size());
      corners.clear();
      for (std::size_t t = first; t < end; ++t) {
        for (int c = 0; c < 3; ++c) {
          SurfacePoint& corner = corners.emplace_back(SurfacePoint{.mesh = number});
          corner.triangle = static_cast<std::uint32_t>(t);
          corner.u = c == 1 ? 1.f : 0.f, corner.v = c == 2 ? 1.f : 0.f;
          corner.keeps_normal = true;
          corner.instance = placed.instance;
        }
      }
      geometry.fill(corners, needs, camera_, buffer);
      const Bounds offsets = shader.displacement_box(buffer.batch);
      for (std::size_t t = first; t < end; ++t) {
        Bounds places;
        for (const std::uint32_t v : mesh.triangles[t].v) places.add(mesh.position[v]);
        known.add(places, offsets);
      }
    }
    return known;
  }

  Scene& scene_;
  const PixelCamera& camera_;
  Vec3 eye_;
  const DisplaceSettings& settings_;
  std::size_t left_;                              ///< Triangles that may come.
  std::vector<std::optional<OffsetGrid>> known_;  ///< By mesh.
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
  std::vector<std::uint32_t> moved;
  for (std::uint32_t i = 0; i < shaders.size(); ++i) {
    if (moves(i)) moved.push_back(i);
  }
  for (const std::uint32_t i : moved) {
    if (!scene.meshes[i].poses.empty()) {
      scene.meshes[i].poses.clear();
      result.stopped.push_back(i);
    }
    give_flat_vertices(scene.meshes[i]);
  }
  const SurfaceGeometry geometry(scene, settings.clock);
  std::set<std::uint32_t> coarse;
  for (const std::uint32_t i : moved) {
    if (!displacer.split(i, *shaders[i], geometry)) coarse.insert(i);
  }
  std::vector<std::vector<Vec3>> offsets;
  for (const std::uint32_t i : moved) {
    offsets.push_back(displacer.ask(i, *shaders[i], geometry));
    const std::size_t before = scene.meshes[i].triangles.size();
    if (!displacer.refine(i, offsets.back())) coarse.insert(i);
    if (scene.meshes[i].triangles.size() == before) continue;
    offsets.back() = displacer.ask(i, *shaders[i], geometry);
  }
  for (std::size_t k = 0; k < moved.size(); ++k) {
    result.invalid += displacer.move(moved[k], std::move(offsets[k]));
  }
  result.coarse.assign(coarse.begin(), coarse.end());
  return result;
}

}  // namespace nacre::host
