#include <algorithm>

#include "examples/render/area_light.h"
#include "examples/render/offset.h"
#include "examples/render/scene_limits.h"
#include "examples/render/wavefront.h"

namespace nacre::host {

/// One light sample for every path that can use one.
void Wavefront::sample_lights() {
  asking_.clear();
  for (std::size_t m = 0; m < groups_.size(); ++m) {
    const Capabilities& can = context_.materials[m].capabilities;
    if (!can.scatters || can.only_delta) continue;
    for (std::uint32_t k = groups_[m].begin; k < groups_[m].end; ++k) {
      const std::uint32_t i = sorted_[k];
      const Path& path = paths_[i];
      const Hit& hit = hits_[i];
      light_samples_[i] = {};
      if (path.depth >= context_.settings.max_depth) continue;
      // Not from inside of what has a surface: that is in the way.
      if (!path.media.is_open(hit.mesh, hit.instance)) continue;
      if (!context_.scene.meshes[hit.mesh].illuminated) continue;
      asking_.push_back(i);
    }
  }
  choose_lights();
  ask_lights();
}

/// For all that ask.
void Wavefront::choose_lights() {
  draw(asking_, Draw::light, numbers_);
  if (!context_.lights.asks_where()) {
    lit_by_sky_ = asking_;
    sky_numbers_ = numbers_;
    return;
  }
  draw(asking_, Draw::light_choice, more_numbers_);
  for (std::size_t k = 0; k < asking_.size(); ++k) {
    const std::uint32_t i = asking_[k];
    const Path& path = paths_[i];
    choose_light(i,
                 {hits_[i].mesh, hits_[i].instance, path.ray.time,
                  surface_position(context_.scene, surface_point(i)), -path.ray.direction},
                 lit_normal(i), {more_numbers_[k], numbers_[k]});
  }
}

/// Of the surface that a path is at.
Vec3 Wavefront::lit_normal(std::uint32_t i) const {
  if (context_.scene.meshes[hits_[i].mesh].is_fibres()) return {};
  return surface_normal(context_.scene, surface_point(i));
}

/// Draws what lights a path from there; ask_lights() completes it.
void Wavefront::choose_light(std::uint32_t i, const InnerPoint& from, Vec3 normal,
                             LightNumbers numbers) {
  LightSample& light = light_samples_[i];
  light = {};
  const SceneLights::Choice choice = context_.lights.choose({from.P, normal}, numbers.light);
  if (choice.kind == SceneLights::Kind::none) return;
  if (choice.kind == SceneLights::Kind::environment) {
    lit_by_sky_.push_back(i);
    sky_numbers_.push_back(numbers.place);
    return;
  }
  if (choice.kind == SceneLights::Kind::unmet) {
    lit_.push_back({i, choice.light, choice.probability, from});
    return;
  }
  const Vec2 at = sample_triangle(numbers.place);
  SurfacePoint light_point{choice.mesh, choice.triangle, at.x, at.y, {}, false, 0.f, 0.f,
                           0,           from.time};
  const Vec3 on_light = surface_position(context_.scene, light_point);
  const Vec3 ng = surface_normal(context_.scene, light_point);
  const Vec3 way = on_light - from.P;
  const float squared = dot(way, way);
  if (!(squared > 0.f) || !std::isfinite(squared)) return;
  const Vec3 wi = normalize(way);
  const float cosine = dot(ng, wi);
  const bool back = cosine > 0.f;
  if (!(back ? choice.back : choice.front)) return;  // Found by paths, if it shines at all.
  const float pdf = choice.probability / choice.area * squared / std::abs(cosine);
  if (!std::isfinite(pdf)) return;  // edge on
  light = {wi, {}, offset_point(on_light, back ? -ng : ng), pdf, false};
  light.group = context_.settings.passes.groups.mesh(choice.mesh);
  light_point.wo = -wi;
  light_points_.push_back({i, light_point});
}

/// Emission of the points that are chosen, in batches of their own, by the material of the light;
/// and what the others send.
void Wavefront::ask_lights() {
  ask_environment();
  group_by(light_points_.size(), light_order_, light_groups_,
           [this](std::size_t k) { return context_.material_of(light_points_[k].point); });
  for (std::size_t m = 0; m < light_groups_.size(); ++m) {
    const Group g = light_groups_[m];
    for_batches(std::span<const std::uint32_t>(light_order_.data() + g.begin, g.end - g.begin),
                buffer_.capacity(), [&](std::span<const std::uint32_t> points) {
                  light_emission(context_.materials[m], points);
                });
  }
  light_points_.clear();
  group_by(lit_.size(), lit_order_, lit_groups_, [this](std::size_t k) { return lit_[k].light; });
  for (std::size_t light = 0; light < lit_groups_.size(); ++light) {
    const Group g = lit_groups_[light];
    for_batches(std::span<const std::uint32_t>(lit_order_.data() + g.begin, g.end - g.begin),
                buffer_.capacity(), [&](std::span<const std::uint32_t> lit) {
                  light_points(*context_.point_lights[light], lit);
                });
  }
  lit_.clear();
}

void Wavefront::ask_environment() {
  if (lit_by_sky_.empty()) return;
  sky_samples_.resize(lit_by_sky_.size());
  context_.environment->sample(sky_numbers_, sky_samples_);
  const float chance = context_.lights.environment_chance();
  for (std::size_t k = 0; k < lit_by_sky_.size(); ++k) {
    const Environment::Sample& s = sky_samples_[k];
    LightSample& light = light_samples_[lit_by_sky_[k]];
    light.wi = s.wi;
    light.radiance = s.radiance;
    light.target = {};
    light.pdf = chance * s.pdf;
    light.infinite = true;
    light.unseen = false;
    light.group = context_.settings.passes.groups.of_environment;
  }
  lit_by_sky_.clear();
  sky_numbers_.clear();
}

void Wavefront::light_emission(const Material& material, std::span<const std::uint32_t> points) {
  if (!material.capabilities.emits) return;  // The dark side of a light.
  points_.clear();
  for (const std::uint32_t k : points) points_.push_back(light_points_[k].point);
  context_.geometry.fill(points_, material.capabilities, context_.camera, buffer_);
  draw_texels(points, [&](std::uint32_t k) { return light_points_[k].path; }, Draw::light_texel);
  const Stopwatch watch(counts_.shading_seconds);
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

/// What the points where paths are see of a light.
void Wavefront::light_points(const LightShader& light, std::span<const std::uint32_t> lit) {
  inner_points_.clear();
  for (const std::uint32_t k : lit) inner_points_.push_back(lit_[k].point);
  Capabilities needs;
  needs.attributes = attribute_time;
  context_.geometry.fill_within(inner_points_, needs, context_.camera, buffer_);
  const LightLanes seen{buffer_.rgb, buffer_.wi, buffer_.value.pdf};
  {
    const Stopwatch watch(counts_.shading_seconds);
    light.light(buffer_.batch, seen);
  }
  for (std::size_t lane = 0; lane < lit.size(); ++lane) {
    const Vec3 direction = normalize_or(load(seen.direction, lane), {});
    const Vec3 intensity = load(seen.intensity, lane);
    // A point that is the light has no direction to it.
    if (is_zero(direction) || is_zero(intensity)) continue;
    const float distance = seen.distance[lane];
    const bool infinite = !(distance < largest_coordinate);
    const Vec3 target = load(buffer_.batch.P, lane) + (infinite ? 0.f : distance) * direction;
    const LitPoint& at = lit_[lit[lane]];
    light_samples_[at.path] = {direction,
                               intensity,
                               target,
                               at.probability,
                               infinite,
                               true,
                               context_.settings.passes.groups.light(at.light)};
  }
}

}  // namespace nacre::host
