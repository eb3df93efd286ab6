#include <algorithm>
#include <cmath>

#include "examples/render/wavefront.h"

namespace nacre::host {

/// Takes what is lost on the way to what shadow rays meet. Where it differs from place to place:
/// a product over points that are drawn by the bound, whose mean is Beer's law (ratio tracking;
/// Novák, Selle and Jarosz, "Residual Ratio Tracking for Estimating Attenuation in Participating
/// Media", SIGGRAPH Asia 2014, eq. 9).
void Wavefront::dim_shadows() {
  met_.clear();
  for (std::uint32_t i = 0; i < shadows_.size(); ++i) {
    const Media& media = shadow_media_[i].media;
    if (media.empty()) continue;
    if (media.current().varies()) {
      met_at_[i] = 0.f;
      if (may_dim(i)) met_.push_back(i);
    } else {
      const float far =
          std::min(shadows_[i].ray.far, ray_hits_[i].missed() ? INFINITY : ray_hits_[i].distance);
      shadows_[i].contribution *= transmittance(media.current(), far);
    }
  }
  while (!met_.empty()) {
    group_by(met_.size(), met_order_, met_groups_,
             [this](std::size_t k) { return shadow_media_[met_[k]].media.current().varies_by; });
    for (std::uint32_t& k : met_order_) k = met_[k];
    for (std::size_t m = 0; m < met_groups_.size(); ++m) {
      const Group g = met_groups_[m];
      for_batches(std::span<const std::uint32_t>(met_order_.data() + g.begin, g.end - g.begin),
                  buffer_.capacity(), [&](std::span<const std::uint32_t> shadows) {
                    dim_by_points(context_.materials[m], shadows);
                  });
    }
    std::erase_if(met_, [this](std::uint32_t i) { return !may_dim(i); });
  }
}

/// Goes to the next point on the way of a shadow ray where something may be. False where it meets
/// a surface before, or has no light left.
bool Wavefront::may_dim(std::uint32_t i) {
  Vec3& contribution = shadows_[i].contribution;
  if (is_zero(contribution)) return false;
  ShadowMedia& in = shadow_media_[i];
  if (in.key.step >= static_cast<std::uint32_t>(context_.settings.max_scatterings)) {
    contribution = {};
    ++counts_.paths_cut;
    return false;
  }
  ++in.key.step;
  const Uniform2 u = uniform2(context_.settings.sampler, in.key, Draw::shadow);
  met_at_[i] += sample_bound(in.media.current().bound, u.x);
  const float far = ray_hits_[i].missed() ? shadows_[i].ray.far : ray_hits_[i].distance;
  return met_at_[i] < far;
}

void Wavefront::dim_by_points(const Material& material, std::span<const std::uint32_t> shadows) {
  inner_points_.clear();
  for (const std::uint32_t i : shadows) {
    const Ray& ray = shadows_[i].ray;
    const Media& media = shadow_media_[i].media;
    inner_points_.push_back({media.mesh(), media.instance(), ray.time,
                             ray.origin + met_at_[i] * ray.direction, -ray.direction});
  }
  context_.geometry.fill_within(inner_points_, material.capabilities, context_.camera, buffer_);
  {
    const Stopwatch watch(counts_.shading_seconds);
    material.shader->volume(buffer_.batch, buffer_.within);
  }
  for (std::size_t lane = 0; lane < shadows.size(); ++lane) {
    const std::uint32_t i = shadows[lane];
    const Medium there = medium_of(buffer_.within, lane);
    const float bound = shadow_media_[i].media.current().bound;
    const Vec3 lost = there.absorption + there.scattering;
    if (max_component(lost) > bound) ++counts_.beyond_bound;
    shadows_[i].contribution *= (1.f / bound) * (Vec3{bound, bound, bound} - lost);
  }
}

/// Goes through the border of a volume.
void Wavefront::cross_border(const Material& material, std::span<const std::uint32_t> shadows) {
  fill_shadows(shadows, material);
  if (!material.capabilities.volume_varies) {
    const Stopwatch watch(counts_.shading_seconds);
    material.shader->volume(buffer_.batch, buffer_.within);
  }
  for (std::size_t lane = 0; lane < shadows.size(); ++lane) {
    const std::uint32_t i = shadows[lane];
    take_through(shadow_media_[i].media, material, ray_hits_[i], lane, shadows_[i].ray.direction);
    go_on(i, lane);
  }
}

}  // namespace nacre::host
