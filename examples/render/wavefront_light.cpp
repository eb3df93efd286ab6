#include <algorithm>

#include "examples/render/offset.h"
#include "examples/render/scene_limits.h"
#include "examples/render/wavefront.h"

namespace nacre::host {

/// One light sample for every path that can use one. Emission is evaluated in
/// batches of its own, sorted by the material of the light.
void Wavefront::sample_lights() {
  light_points_.clear();
  lit_.clear();
  for (std::size_t m = 0; m < groups_.size(); ++m) {
    const Capabilities& can = context_.materials[m].capabilities;
    if (!can.scatters || can.only_delta) continue;
    for (std::uint32_t k = groups_[m].begin; k < groups_[m].end; ++k) sample_light(sorted_[k]);
  }
  group_by(light_points_.size(), light_order_, light_groups_,
           [this](std::size_t i) { return context_.material_of(light_points_[i].point); });
  for (std::size_t m = 0; m < light_groups_.size(); ++m) {
    const Group g = light_groups_[m];
    for_batches(std::span<const std::uint32_t>(light_order_.data() + g.begin, g.end - g.begin),
                buffer_.capacity(), [&](std::span<const std::uint32_t> points) {
                  light_emission(context_.materials[m], points);
                });
  }
  group_by(lit_.size(), lit_order_, lit_groups_, [this](std::size_t i) { return lit_[i].second; });
  for (std::size_t k = 0; k < lit_groups_.size(); ++k) {
    const Group g = lit_groups_[k];
    for (std::uint32_t i = g.begin; i < g.end; ++i) lit_order_[i] = lit_[lit_order_[i]].first;
    for_batches(std::span<const std::uint32_t>(lit_order_.data() + g.begin, g.end - g.begin),
                buffer_.capacity(), [&](std::span<const std::uint32_t> paths) {
                  light_points(*context_.point_lights[k], paths);
                });
  }
}

void Wavefront::sample_light(std::uint32_t i) {
  const Path& path = paths_[i];
  LightSample& light = light_samples_[i];
  light = {};
  if (path.depth >= context_.settings.max_depth) return;
  // Not through a medium: what weakens the light on its way is found by paths.
  if (path.media.encloses(hits_[i].mesh, hits_[i].instance)) return;
  if (!context_.scene.meshes[hits_[i].mesh].illuminated) return;
  const Uniform2 choice = draw(path, Draw::light_choice);
  const Uniform2 position = draw(path, Draw::light);
  if (choice.x < context_.environment_chance) {
    const Environment::Sample s = context_.environment->sample(position);
    light = {s.wi, s.radiance, {}, context_.environment_chance * s.pdf, true};
    return;
  }
  if (choice.x >= 1.f - context_.point_chance) {
    const auto count = static_cast<float>(context_.point_lights.size());
    const auto last = static_cast<std::uint32_t>(context_.point_lights.size() - 1);
    lit_.emplace_back(i, std::min(static_cast<std::uint32_t>(choice.y * count), last));
    return;
  }
  const AreaLights::Sample s = context_.lights.sample(choice.y, position);
  SurfacePoint light_point{s.mesh, s.triangle, s.u, s.v, {}, false, 0.f, 0.f, 0, path.ray.time};
  const Vec3 on_light = surface_position(context_.scene, light_point);
  const Vec3 ng = surface_normal(context_.scene, light_point);
  const Vec3 from = surface_position(context_.scene, surface_point(i));
  const Vec3 way = on_light - from;
  const float squared = dot(way, way);
  if (!(squared > 0.f) || !std::isfinite(squared)) return;
  const Vec3 wi = normalize(way);
  const float cosine = dot(ng, wi);
  const float area_pdf = context_.area_chance * s.area_pdf;
  const float pdf = area_pdf * squared / std::abs(cosine);
  if (!std::isfinite(pdf)) return;  // edge on
  light = {wi, {}, offset_point(on_light, cosine > 0.f ? -ng : ng), pdf, false};
  light_point.wo = -wi;
  light_points_.push_back({i, light_point});
}

void Wavefront::light_emission(const Material& material, std::span<const std::uint32_t> points) {
  if (!material.capabilities.emits) return;  // The dark side of a light.
  points_.clear();
  for (const std::uint32_t k : points) points_.push_back(light_points_[k].point);
  context_.geometry.fill(points_, material.capabilities, context_.camera, buffer_);
  const Stopwatch watch(statistics_.shading_seconds);
  material.shader->emission(buffer_.batch, buffer_.rgb);
  for (std::size_t lane = 0; lane < points.size(); ++lane) {
    light_samples_[light_points_[points[lane]].path].radiance = load(buffer_.rgb, lane);
  }
  if (!material.capabilities.has_opacity) return;
  material.shader->opacity(buffer_.batch, buffer_.rgb);
  for (std::size_t lane = 0; lane < points.size(); ++lane) {
    light_samples_[light_points_[points[lane]].path].radiance *=
        clamp_unit(load(buffer_.rgb, lane));
  }
}

/// What the points where paths met something see of a light.
void Wavefront::light_points(const LightShader& light, std::span<const std::uint32_t> paths) {
  points_.clear();
  for (const std::uint32_t i : paths) points_.push_back(surface_point(i));
  Capabilities needs;
  needs.attributes = attribute_time;
  context_.geometry.fill(points_, needs, context_.camera, buffer_);
  const LightLanes seen{buffer_.rgb, buffer_.wi, buffer_.value.pdf};
  {
    const Stopwatch watch(statistics_.shading_seconds);
    light.light(buffer_.batch, seen);
  }
  const float pdf = context_.point_chance / static_cast<float>(context_.point_lights.size());
  for (std::size_t lane = 0; lane < paths.size(); ++lane) {
    const Vec3 direction = normalize_or(load(seen.direction, lane), {});
    const Vec3 intensity = load(seen.intensity, lane);
    // A point that is the light has no direction to it.
    if (is_zero(direction) || is_zero(intensity)) continue;
    const float distance = seen.distance[lane];
    const bool infinite = !(distance < largest_coordinate);
    const Vec3 target = load(buffer_.batch.P, lane) + (infinite ? 0.f : distance) * direction;
    light_samples_[paths[lane]] = {direction, intensity, target, pdf, infinite, true};
  }
}

}  // namespace nacre::host
