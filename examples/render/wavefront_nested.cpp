#include <vector>

#include "examples/render/medium_lanes.h"
#include "examples/render/wavefront.h"

namespace nacre::host {

/// Whether a solid of a higher priority is where a path met a surface: as if that was not there.
bool Wavefront::is_hidden(std::uint32_t i) const {
  const Hit& hit = hits_[i];
  if (!context_.is_solid(hit.mesh)) return false;
  const Media& media = paths_[i].media;
  const SurfacePoint point = surface_point(i);
  if (dot(surface_normal(context_.scene, point), point.wo) < 0.f) {
    return media.hides_exit(hit.mesh, hit.instance);
  }
  return media.hides_entry(context_.scene.meshes[hit.mesh].priority);
}

/// Takes the paths that meet hidden surfaces through them, and out of their groups.
void Wavefront::pass_hidden() {
  for (std::size_t m = 0; m < groups_.size(); ++m) {
    Group& group = groups_[m];
    std::uint32_t end = group.begin;
    std::vector<std::uint32_t> hidden;
    for (std::uint32_t k = group.begin; k < group.end; ++k) {
      const std::uint32_t i = sorted_[k];
      if (is_hidden(i)) {
        hidden.push_back(i);
      } else {
        sorted_[end++] = i;
      }
    }
    group.end = end;
    for_batches(
        std::span<const std::uint32_t>(hidden), buffer_.capacity(),
        [&](std::span<const std::uint32_t> paths) { pass_hidden(context_.materials[m], paths); });
  }
}

void Wavefront::pass_hidden(const Material& material, std::span<const std::uint32_t> paths) {
  fill(paths, material);
  ask_interior(material);
  for (std::size_t lane = 0; lane < paths.size(); ++lane) {
    const std::uint32_t i = paths[lane];
    Path& path = paths_[i];
    const Hit& hit = hits_[i];
    if (++path.passes > context_.settings.max_transparent) continue;
    if (dot(load(buffer_.batch.Ng, lane), path.ray.direction) < 0.f) {
      enter_solid(path.media, hit, lane);
    } else {
      path.media.leave(hit.mesh, hit.instance);
    }
    path.ray.origin = leave(buffer_, lane, path.ray.direction);
    path.distance += hit.distance;
    ++path.key.event;
    next_.push_back(i);
  }
}

/// What is around the points of a batch: where light enters what the path is inside of, and where
/// it leaves a solid what else it is inside of.
void Wavefront::fill_exterior(std::span<const std::uint32_t> paths) {
  for (std::size_t lane = 0; lane < paths.size(); ++lane) {
    const Media& media = paths_[paths[lane]].media;
    const Hit& hit = hits_[paths[lane]];
    const bool leaves = dot(load(buffer_.batch.Ng, lane), load(buffer_.batch.wo, lane)) < 0.f;
    buffer_.batch.exterior_index[lane] =
        leaves ? media.index_outside(hit.mesh, hit.instance) : media.index();
  }
}

/// What light is in behind the surface, as if vacuum was around: its index is that of the inside.
void Wavefront::ask_interior(const Material& material) {
  if (!material.capabilities.has_interior) return;
  ShadingBatch in_vacuum = buffer_.batch;
  in_vacuum.exterior_index = buffer_.vacuum;
  material.shader->interior(in_vacuum, buffer_.interior);
}

void Wavefront::enter_solid(Media& media, const Hit& hit, std::size_t lane) {
  const Dielectric dielectric =
      dielectric_of(buffer_.interior, lane, context_.scene.meshes[hit.mesh].priority);
  if (!media.enter(hit.mesh, hit.instance, medium_of(buffer_.interior, lane), dielectric)) {
    ++counts_.media_dropped;
  }
}

}  // namespace nacre::host
