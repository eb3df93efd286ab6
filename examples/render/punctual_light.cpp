#include "examples/render/punctual_light.h"

#include <algorithm>
#include <cmath>

#include "examples/render/batch_buffer.h"
#include "examples/render/scene_limits.h"

namespace nacre::host {

namespace {

float falloff(const PunctualLight& light, float distance) {
  const float square = 1.f / (distance * distance);
  if (!(light.range > 0.f)) return square;
  const float share = distance / light.range;
  return std::clamp(1.f - share * share * share * share, 0.f, 1.f) * square;
}

float cone(const PunctualLight& light, Vec3 to_light) {
  const float cosine = -dot(light.direction, to_light);
  const float width = std::max(0.001f, light.inner_cos - light.outer_cos);
  const float part = std::clamp((cosine - light.outer_cos) / width, 0.f, 1.f);
  return part * part;
}

}  // namespace

void PunctualShader::light(const ShadingBatch& batch, LightLanes out) const {
  for (std::size_t i = 0; i < batch.count; ++i) {
    if (light_.kind == PunctualLight::Kind::directional) {
      store(out.intensity, i, light_.color);
      store(out.direction, i, -light_.direction);
      out.distance[i] = INFINITY;
      continue;
    }
    const Vec3 way = light_.position - load(batch.P, i);
    const float distance = length(way);
    const Vec3 unit = normalize_or(way, {});
    float scale = distance > 0.f && std::isfinite(distance) ? falloff(light_, distance) : 0.f;
    if (light_.kind == PunctualLight::Kind::spot) scale *= cone(light_, unit);
    store(out.intensity, i, scale * light_.color);
    store(out.direction, i, scale > 0.f ? unit : Vec3{});
    out.distance[i] = distance;
  }
}

std::optional<LightBounds> PunctualShader::bounds() const {
  if (light_.kind == PunctualLight::Kind::directional) return {};
  LightBounds b;
  if (!is_within_reach(light_.position)) return b;  // Dark, for nothing of it arrives.
  b.box.add(light_.position);
  b.intensity = double{luminance(light_.color)};
  if (light_.range > 0.f) b.reach = light_.range;
  if (light_.kind == PunctualLight::Kind::spot) {
    b.cone = DirectionCone::about(light_.direction, 1.f);
    b.cos_e = light_.outer_cos;
  }
  return b;
}

}  // namespace nacre::host
