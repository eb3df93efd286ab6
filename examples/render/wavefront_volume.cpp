#include <algorithm>
#include <cmath>

#include "examples/render/wavefront.h"

namespace nacre::host {

/// Whether a path in what varies is to be looked at before it meets a surface.
bool Wavefront::may_meet(std::uint32_t i, const Medium& medium, float far) {
  const float distance = sample_bound(medium.bound, draw(paths_[i], Draw::flight).y);
  if (!(distance < far)) return false;
  met_.push_back(i);
  met_at_[i] = distance;
  return true;
}

/// What there is where paths may meet something.
void Wavefront::meet_media() {
  group_by(met_.size(), met_order_, met_groups_,
           [this](std::size_t k) { return paths_[met_[k]].media.current().varies_by; });
  for (std::uint32_t& k : met_order_) k = met_[k];
  for (std::size_t m = 0; m < met_groups_.size(); ++m) {
    const Group g = met_groups_[m];
    for_batches(std::span<const std::uint32_t>(met_order_.data() + g.begin, g.end - g.begin),
                buffer_.capacity(), [&](std::span<const std::uint32_t> paths) {
                  meet_medium(context_.materials[m], paths);
                });
  }
}

void Wavefront::meet_medium(const Material& material, std::span<const std::uint32_t> paths) {
  inner_points_.clear();
  for (const std::uint32_t i : paths) {
    const Path& path = paths_[i];
    const Vec3 P = path.ray.origin + met_at_[i] * path.ray.direction;
    inner_points_.push_back(
        {path.media.mesh(), path.media.instance(), path.ray.time, P, -path.ray.direction});
  }
  context_.geometry.fill_within(inner_points_, material.capabilities, context_.camera, buffer_);
  {
    const Stopwatch watch(counts_.shading_seconds);
    material.shader->volume(buffer_.batch, buffer_.within);
  }
  for (std::size_t lane = 0; lane < paths.size(); ++lane) {
    const std::uint32_t i = paths[lane];
    Path& path = paths_[i];
    const float bound = path.media.current().bound;
    const Medium there = medium_of(buffer_.within, lane);
    const Meeting meeting =
        sample_meeting(there, bound, path.throughput, draw(path, Draw::flight).x);
    if (max_component(there.absorption + there.scattering) > bound) ++counts_.beyond_bound;
    add_found(i, (1.f / bound) * (path.throughput * there.emission),
              context_.settings.passes.groups.mesh(path.media.mesh()));
    path.throughput *= meeting.weight;
    if (!is_finite(path.throughput) || !is_finite(there.emission)) {
      ++counts_.invalid_results;
      continue;
    }
    if (is_zero(path.throughput)) continue;
    if (meeting.scatters) {
      if (scatter_inside(i, there, met_at_[i])) next_.push_back(i);
      continue;
    }
    if (++path.scatterings > context_.settings.max_scatterings) {
      ++counts_.paths_cut;
      continue;
    }
    path.ray.origin = inner_points_[lane].P;
    path.distance += met_at_[i];
    ++path.key.event;
    next_.push_back(i);
  }
}

/// Takes the paths that meet the border of a volume through it, and out of their groups.
void Wavefront::enter_volumes() {
  for (std::size_t m = 0; m < groups_.size(); ++m) {
    Group& group = groups_[m];
    if (!context_.materials[m].capabilities.is_volume) continue;
    for_batches(
        std::span<const std::uint32_t>(sorted_.data() + group.begin, group.end - group.begin),
        buffer_.capacity(),
        [&](std::span<const std::uint32_t> paths) { enter_volume(context_.materials[m], paths); });
    group.end = group.begin;
  }
}

void Wavefront::enter_volume(const Material& material, std::span<const std::uint32_t> paths) {
  fill(paths, material);
  if (!material.capabilities.volume_varies) {
    const Stopwatch watch(counts_.shading_seconds);
    material.shader->volume(buffer_.batch, buffer_.within);
  }
  for (std::size_t lane = 0; lane < paths.size(); ++lane) {
    const std::uint32_t i = paths[lane];
    Path& path = paths_[i];
    const Hit& hit = hits_[i];
    if (++path.passes > context_.settings.max_transparent) continue;
    take_through(path.media, material, hit, lane, path.ray.direction);
    path.ray.origin = leave(buffer_, lane, path.ray.direction);
    path.distance += hit.distance;
    ++path.key.event;
    next_.push_back(i);
  }
}

/// What light is inside of behind the border of a lane.
void Wavefront::take_through(Media& media, const Material& material, const Hit& hit,
                             std::size_t lane, Vec3 direction) {
  if (!(dot(load(buffer_.batch.Ng, lane), direction) < 0.f)) {
    return media.leave(hit.mesh, hit.instance);
  }
  const Medium medium =
      material.capabilities.volume_varies
          ? varying_medium(static_cast<std::uint32_t>(&material - context_.materials.data()),
                           context_.bounds[hit.mesh])
          : medium_of(buffer_.within, lane);
  if (!medium.is_empty() && !media.enter(hit.mesh, hit.instance, medium)) {
    ++counts_.media_dropped;
  }
}

}  // namespace nacre::host
