#include <algorithm>

#include "examples/render/wavefront.h"

namespace nacre::host {

/// What a light gives a path, if nothing is in the way from `origin` on. What the path is inside
/// of, the light is too.
void Wavefront::add_shadow(const LightSample& light, std::uint32_t path, Vec3 origin,
                           Vec3 contribution) {
  // Each where it stays: what is put together elsewhere and copied at once waits for its parts.
  ShadowRay& shadow = shadows_.emplace_back();
  Ray& ray = shadow.ray;
  ray.origin = origin;
  ray.direction = light.wi;
  ray.far = INFINITY;
  ray.kind = ray_shadow;
  ray.time = paths_[path].ray.time;
  if (!light.infinite) {
    ray.far = length(light.target - origin);
    ray.direction = normalize_or(light.target - origin, light.wi);
  }
  shadow.contribution = contribution;
  shadow.target = light.target;
  shadow.path = path;
  shadow.infinite = light.infinite;
  if (context_.any_volume) shadow_media_.push_back({paths_[path].media, paths_[path].key});
}

void Wavefront::trace_shadows() {
  if (shadows_.empty()) return;
  if (context_.any_opacity || context_.any_volume) {
    trace_dimmed_shadows();
  } else {
    trace_opaque_shadows();
  }
}

void Wavefront::trace_opaque_shadows() {
  const std::size_t count = shadows_.size();
  for (std::size_t i = 0; i < count; ++i) {
    rays_[i] = shadows_[i].ray;
    rays_[i].kind = ray_shadow;
  }
  counts_.shadow_rays += count;
  {
    const Stopwatch watch(counts_.tracing_seconds);
    context_.bvh.occluded({rays_.data(), count}, {blocked_.data(), count});
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (blocked_[i] == 0) add_connected(shadows_[i]);
  }
}

/// Surface after surface, dimming; what is left after max_transparent is black.
void Wavefront::trace_dimmed_shadows() {
  for (int pass = 0; pass <= context_.settings.max_transparent && !shadows_.empty(); ++pass) {
    const std::size_t count = shadows_.size();
    for (std::size_t i = 0; i < count; ++i) {
      rays_[i] = shadows_[i].ray;
      rays_[i].kind = ray_shadow;
    }
    counts_.shadow_rays += count;
    {
      const Stopwatch watch(counts_.tracing_seconds);
      context_.bvh.intersect({rays_.data(), count}, {ray_hits_.data(), count}, false);
    }
    if (context_.any_volume) dim_shadows();
    group_by(count, shadow_order_, shadow_groups_, [this](std::size_t i) {
      if (ray_hits_[i].missed()) return ~0u;
      const std::uint32_t material = context_.material_of(shadow_point(i));
      const Capabilities& can = context_.materials[material].capabilities;
      return can.has_opacity || can.is_volume ? material : ~0u;
    });
    for (std::size_t i = 0; i < count; ++i) {
      if (ray_hits_[i].missed()) add_connected(shadows_[i]);
    }
    for (std::size_t m = 0; m < shadow_groups_.size(); ++m) {
      const Group g = shadow_groups_[m];
      const Material& material = context_.materials[m];
      for_batches(std::span<const std::uint32_t>(shadow_order_.data() + g.begin, g.end - g.begin),
                  buffer_.capacity(), [&](std::span<const std::uint32_t> shadows) {
                    if (material.capabilities.is_volume) {
                      cross_border(material, shadows);
                    } else {
                      attenuate(material, shadows, static_cast<std::uint32_t>(pass));
                    }
                  });
    }
    // Those that go on, in the order of the sort.
    std::sort(shadow_order_.begin(), shadow_order_.end());
    std::size_t kept = 0;
    for (const std::uint32_t i : shadow_order_) {
      if (!(max_component(shadows_[i].contribution) > 0.f)) continue;
      if (context_.any_volume) shadow_media_[kept] = shadow_media_[i];
      shadows_[kept++] = shadows_[i];
    }
    shadows_.resize(kept);
    if (context_.any_volume) shadow_media_.resize(kept);
  }
}

/// Where shadow ray i met something.
SurfacePoint Wavefront::shadow_point(std::size_t i) const {
  const Hit& hit = ray_hits_[i];
  const Ray& ray = shadows_[i].ray;
  return {hit.mesh, hit.triangle, hit.u,        hit.v,    -ray.direction, false,
          0.f,      0.f,          hit.instance, ray.time, hit.normal};
}

void Wavefront::fill_shadows(std::span<const std::uint32_t> shadows, const Material& material) {
  points_.clear();
  for (const std::uint32_t i : shadows) points_.push_back(shadow_point(i));
  context_.geometry.fill(points_, material.capabilities, context_.camera, buffer_);
}

/// `met`: how many surfaces the shadow rays have met before.
void Wavefront::attenuate(const Material& material, std::span<const std::uint32_t> shadows,
                          std::uint32_t met) {
  fill_shadows(shadows, material);
  draw_texels(shadows, [&](std::uint32_t i) { return shadows_[i].path; }, Draw::shadow_texel, met);
  {
    const Stopwatch watch(counts_.shading_seconds);
    material.shader->opacity(buffer_.batch, buffer_.rgb);
  }
  for (std::size_t lane = 0; lane < shadows.size(); ++lane) {
    shadows_[shadows[lane]].contribution *=
        Vec3{1.f, 1.f, 1.f} - clamp_unit(load(buffer_.rgb, lane));
    go_on(shadows[lane], lane);
  }
}

/// Behind the surface of a lane.
void Wavefront::go_on(std::size_t i, std::size_t lane) {
  ShadowRay& shadow = shadows_[i];
  shadow.ray.origin = leave(buffer_, lane, shadow.ray.direction);
  if (shadow.infinite) return;
  const Vec3 rest = shadow.target - shadow.ray.origin;
  shadow.ray.far = length(rest);
  shadow.ray.direction = normalize_or(rest, shadow.ray.direction);
}

}  // namespace nacre::host
