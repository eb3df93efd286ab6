#include "examples/render/wavefront.h"

namespace nacre::host {

/// Lets paths through surfaces by chance, and takes those out of their group.
void Wavefront::apply_opacity() {
  for (std::size_t m = 0; m < groups_.size(); ++m) {
    const Material& material = context_.materials[m];
    Group& group = groups_[m];
    if (!material.capabilities.has_opacity || group.begin == group.end) continue;
    const std::span<std::uint32_t> all(sorted_.data() + group.begin, group.end - group.begin);
    std::uint32_t kept = group.begin;
    for_batches(all, buffer_.capacity(), [&](std::span<std::uint32_t> paths) {
      const std::uint32_t stay = pass_through(material, paths);
      std::copy_n(paths.begin(), stay, sorted_.begin() + kept);
      kept += stay;
    });
    group.end = kept;
  }
}

/// Moves the paths that stay to the front of `paths`; returns how many.
std::uint32_t Wavefront::pass_through(const Material& material, std::span<std::uint32_t> paths) {
  fill(paths, material);
  {
    const Stopwatch watch(statistics_.shading_seconds);
    material.shader->opacity(buffer_.batch, buffer_.rgb);
  }
  std::uint32_t stay = 0;
  for (std::size_t lane = 0; lane < paths.size(); ++lane) {
    const std::uint32_t i = paths[lane];
    Path& path = paths_[i];
    const Vec3 opacity = clamp_unit(load(buffer_.rgb, lane));
    const Vec3 clear = Vec3{1.f, 1.f, 1.f} - opacity;
    const float chance = (clear.x + clear.y + clear.z) / 3.f;
    if (!(draw(path, Draw::opacity).x < chance)) {
      path.throughput *= (1.f / (1.f - chance)) * opacity;
      paths[stay++] = i;
      continue;
    }
    if (++path.passes > context_.settings.max_transparent) continue;
    path.throughput *= (1.f / chance) * clear;
    path.ray.origin = leave(buffer_, lane, path.ray.direction);
    path.distance += hits_[i].distance;
    ++path.key.event;
    next_.push_back(i);
  }
  return stay;
}

void Wavefront::trace_shadows() {
  if (shadows_.empty()) return;
  if (context_.any_opacity) {
    trace_transparent_shadows();
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
  statistics_.shadow_rays += count;
  {
    const Stopwatch watch(statistics_.tracing_seconds);
    context_.bvh.occluded({rays_.data(), count}, {blocked_.data(), count});
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (blocked_[i] == 0) paths_[shadows_[i].path].radiance += shadows_[i].contribution;
  }
}

/// Surface after surface, dimming; what is left after max_transparent is black.
void Wavefront::trace_transparent_shadows() {
  for (int pass = 0; pass <= context_.settings.max_transparent && !shadows_.empty(); ++pass) {
    const std::size_t count = shadows_.size();
    for (std::size_t i = 0; i < count; ++i) {
      rays_[i] = shadows_[i].ray;
      rays_[i].kind = ray_shadow;
    }
    statistics_.shadow_rays += count;
    {
      const Stopwatch watch(statistics_.tracing_seconds);
      context_.bvh.intersect({rays_.data(), count}, {ray_hits_.data(), count}, false);
    }
    group_by(count, shadow_order_, shadow_groups_, [this](std::size_t i) {
      if (ray_hits_[i].missed()) return ~0u;
      const std::uint32_t material = context_.material_of(shadow_point(i));
      return context_.materials[material].capabilities.has_opacity ? material : ~0u;
    });
    for (std::size_t i = 0; i < count; ++i) {
      if (ray_hits_[i].missed()) paths_[shadows_[i].path].radiance += shadows_[i].contribution;
    }
    for (std::size_t m = 0; m < shadow_groups_.size(); ++m) {
      const Group g = shadow_groups_[m];
      for_batches(std::span<const std::uint32_t>(shadow_order_.data() + g.begin, g.end - g.begin),
                  buffer_.capacity(), [&](std::span<const std::uint32_t> shadows) {
                    attenuate(context_.materials[m], shadows);
                  });
    }
    // Those that go on, in the order of the sort.
    std::vector<ShadowRay>& all = shadows_;
    std::sort(shadow_order_.begin(), shadow_order_.end());
    std::size_t kept = 0;
    for (const std::uint32_t i : shadow_order_) {
      if (max_component(all[i].contribution) > 0.f) all[kept++] = all[i];
    }
    all.resize(kept);
  }
}

/// Where shadow ray i met something.
SurfacePoint Wavefront::shadow_point(std::size_t i) const {
  const Hit& hit = ray_hits_[i];
  const Ray& ray = shadows_[i].ray;
  return {hit.mesh, hit.triangle, hit.u,        hit.v,    -ray.direction, false,
          0.f,      0.f,          hit.instance, ray.time, hit.normal};
}

void Wavefront::attenuate(const Material& material, std::span<const std::uint32_t> shadows) {
  points_.clear();
  for (const std::uint32_t i : shadows) points_.push_back(shadow_point(i));
  context_.geometry.fill(points_, material.capabilities, context_.camera, buffer_);
  {
    const Stopwatch watch(statistics_.shading_seconds);
    material.shader->opacity(buffer_.batch, buffer_.rgb);
  }
  for (std::size_t lane = 0; lane < shadows.size(); ++lane) {
    ShadowRay& shadow = shadows_[shadows[lane]];
    shadow.contribution *= Vec3{1.f, 1.f, 1.f} - clamp_unit(load(buffer_.rgb, lane));
    shadow.ray.origin = leave(buffer_, lane, shadow.ray.direction);
    if (shadow.infinite) continue;
    const Vec3 rest = shadow.target - shadow.ray.origin;
    shadow.ray.far = length(rest);
    shadow.ray.direction = normalize_or(rest, shadow.ray.direction);
  }
}

}  // namespace nacre::host
