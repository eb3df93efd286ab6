#include "examples/render/render_context.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <utility>

namespace nacre::host {

namespace {

/// Image samples are closer than pixels; textures need only as much blur as that
/// leaves, but never less than an eighth of a pixel.
float sample_spacing(const RenderSettings& settings) {
  return std::max(0.125f, 1.f / std::sqrt(static_cast<float>(std::max(settings.samples, 1))));
}

bool wants_one_mesh(const Capabilities& c) {
  return (c.attributes & attribute_transform) != 0 || !c.primvars.empty();
}

}  // namespace

RenderContext::RenderContext(const RenderInput& input, const RenderSettings& wanted,
                             Diagnostics& diagnostics)
    : scene(*input.scene),
      environment(input.environment),
      settings(wanted),
      camera(input.camera, wanted.width, wanted.height, sample_spacing(wanted)),
      geometry(scene),
      bvh(scene, diagnostics) {
  assert(input.shaders.size() == scene.meshes.size());
  if (environment != nullptr && !(environment->mean_luminance() > 0.f)) environment = nullptr;
  collect_materials(input);
  collect_lights();
  environment_chance = environment == nullptr ? 0.f : (lights.empty() ? 1.f : 0.5f);
}

void RenderContext::collect_materials(const RenderInput& input) {
  std::map<std::pair<const Shader*, std::uint32_t>, std::uint32_t> known;
  for (std::uint32_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
    const Mesh& m = scene.meshes[mesh];
    const Shader* shader = input.shaders[mesh];
    if (m.light_radiance) {
      emitters_.push_back(std::make_unique<ConstantEmitter>(*m.light_radiance, m.light_two_sided));
      shader = emitters_.back().get();
    }
    assert(shader != nullptr);
    Capabilities capabilities = shader->capabilities();
    const std::uint32_t split = wants_one_mesh(capabilities) ? mesh : ~0u;
    const auto [slot, fresh] =
        known.try_emplace({shader, split}, static_cast<std::uint32_t>(materials.size()));
    material_of_mesh.push_back(slot->second);
    if (!fresh) continue;
    any_opacity = any_opacity || capabilities.has_opacity;
    state_bytes = std::max(state_bytes, shader->state_bytes(settings.batch_size));
    primvars = std::max(primvars, capabilities.primvars.size());
    materials.push_back({shader, std::move(capabilities)});
  }
}

void RenderContext::collect_lights() {
  BatchBuffer buffer(settings.batch_size, 0, primvars);
  buffer.batch.time = settings.time;
  buffer.batch.frame = settings.frame;
  for (std::uint32_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
    if (!materials[material_of_mesh[mesh]].capabilities.emits) continue;
    lights.add(scene, mesh, triangle_luminance(mesh, buffer));
  }
  lights.finish();
}

/// The larger of the mean luminances that leave the two sides of each triangle
/// perpendicularly, from its centroid and three points halfway to the corners.
std::vector<float> RenderContext::triangle_luminance(std::uint32_t mesh,
                                                     BatchBuffer& buffer) const {
  constexpr float probes[4][2] = {{1.f / 3.f, 1.f / 3.f},
                                  {1.f / 6.f, 1.f / 6.f},
                                  {2.f / 3.f, 1.f / 6.f},
                                  {1.f / 6.f, 2.f / 3.f}};
  const Mesh& m = scene.meshes[mesh];
  const Material& material = materials[material_of_mesh[mesh]];
  std::vector<float> result(m.triangles.size(), 0.f);
  std::vector<SurfacePoint> points;
  std::vector<float> sums;
  for (std::size_t first = 0; first < m.triangles.size();) {
    const std::size_t last =
        std::min(m.triangles.size(), first + std::max(1u, settings.batch_size / 8));
    points.clear();
    for (std::size_t t = first; t < last; ++t) {
      const auto triangle = static_cast<std::uint32_t>(t);
      const Vec3 n = surface_normal(m, triangle);
      for (const Vec3 wo : {n, -n}) {
        for (const auto& [u, v] : probes) {
          points.push_back({mesh, triangle, u, v, wo, false, 0.f, 0.f});
        }
      }
    }
    geometry.fill(points, material.capabilities, camera, buffer);
    material.shader->emission(buffer.batch, buffer.rgb);
    sums.assign(2 * (last - first), 0.f);
    for (std::size_t i = 0; i < points.size(); ++i) {
      sums[i / 4] += 0.25f * std::max(0.f, luminance(load(buffer.rgb, i)));
    }
    for (std::size_t t = first; t < last; ++t) {
      result[t] = std::max(sums[2 * (t - first)], sums[2 * (t - first) + 1]);
    }
    first = last;
  }
  // Where the probes saw nothing a texture may still glow: keep some chance there.
  const float brightest = *std::max_element(result.begin(), result.end());
  for (float& l : result) l = std::max(l, 0.02f * brightest);
  return result;
}

}  // namespace nacre::host
