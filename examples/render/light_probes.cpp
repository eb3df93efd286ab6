#include "examples/render/light_probes.h"

#include <algorithm>
#include <cmath>

#include "examples/render/mesh.h"

namespace nacre::host {

namespace {

/// Barycentric, and towards the viewer: the share along the normal, and the angle around it in
/// eighths. A thin beam along the normal is seen as well as what shines to the sides.
struct Probe {
  float u, v, along, around;
};
constexpr Probe probes[] = {{1.f / 3.f, 1.f / 3.f, 1.f, 0.f},
                            {1.f / 6.f, 1.f / 6.f, 0.9f, 1.f},
                            {2.f / 3.f, 1.f / 6.f, 0.7f, 4.f},
                            {1.f / 6.f, 2.f / 3.f, 0.5f, 6.f}};
constexpr std::size_t probe_count = std::size(probes);

Vec3 towards(const Probe& probe, Vec3 normal) {
  const Vec3 across = perpendicular(normal);
  const float angle = 0.785398f * probe.around;
  const float width = std::sqrt(1.f - probe.along * probe.along);
  return normalize(probe.along * normal + width * std::cos(angle) * across +
                   width * std::sin(angle) * cross(normal, across));
}

float usable(float luminance) { return std::isfinite(luminance) ? std::max(luminance, 0.f) : 0.f; }

}  // namespace

std::vector<float> probe_side(const RenderContext& context, std::uint32_t mesh, bool back,
                              BatchBuffer& buffer) {
  const Material& material =
      context.materials[(back ? context.back_materials : context.front_materials)[mesh]];
  if (!material.capabilities.emits) return {};
  const std::size_t count = context.scene.meshes[mesh].triangles.size();
  const std::size_t at_once = std::max<std::size_t>(1, buffer.capacity() / probe_count);
  std::vector<float> result(count, 0.f);
  std::vector<SurfacePoint> points;
  for (std::size_t first = 0; first < count; first += at_once) {
    const std::size_t last = std::min(count, first + at_once);
    points.clear();
    for (std::size_t t = first; t < last; ++t) {
      const auto triangle = static_cast<std::uint32_t>(t);
      const Vec3 n = surface_normal(context.scene, {.mesh = mesh, .triangle = triangle});
      for (const Probe& probe : probes) {
        points.push_back(
            {mesh, triangle, probe.u, probe.v, towards(probe, back ? -n : n), false, 0.f, 0.f});
      }
    }
    context.geometry.fill(points, material.capabilities, context.camera, buffer);
    material.shader->emission(buffer.batch, buffer.rgb);
    for (std::size_t i = 0; i < points.size(); ++i) {
      result[first + i / probe_count] +=
          usable(luminance(load(buffer.rgb, i))) / static_cast<float>(probe_count);
    }
  }
  return result;
}

float probe_light(const RenderContext& context, const LightShader& light, BatchBuffer& buffer) {
  constexpr int steps = 4;  // Along each axis.
  const Bounds box = bounds(context.scene);
  if (context.scene.meshes.empty() || box.empty()) return 0.f;
  const Vec3 size = box.high - box.low;
  double sum = 0.0;
  std::vector<InnerPoint> points;
  const auto ask = [&] {
    Capabilities needs;
    needs.attributes = attribute_time;
    context.geometry.fill_within(points, needs, context.camera, buffer);
    const LightLanes seen{buffer.rgb, buffer.wi, buffer.value.pdf};
    light.light(buffer.batch, seen);
    for (std::size_t i = 0; i < points.size(); ++i) {
      sum += double{usable(luminance(load(seen.intensity, i)))};
    }
    points.clear();
  };
  const auto share = [](int i) { return (static_cast<float>(i) + 0.5f) / steps; };
  for (int i = 0; i < steps * steps * steps; ++i) {
    const Vec3 at = {share(i % steps), share(i / steps % steps), share(i / (steps * steps))};
    points.push_back({0, 0, 0.f, box.low + at * size, {0.f, 0.f, 1.f}});
    if (points.size() == buffer.capacity()) ask();
  }
  if (!points.empty()) ask();
  return usable(static_cast<float>(sum / (steps * steps * steps)));
}

}  // namespace nacre::host
