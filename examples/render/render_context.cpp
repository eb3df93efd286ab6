#include "examples/render/render_context.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "examples/render/exit_shader.h"
#include "examples/render/mesh.h"
#include "examples/render/volumes_around.h"

namespace nacre::host {

namespace {

/// Image samples are closer than pixels; textures need only as much blur as that
/// leaves, but never less than an eighth of a pixel.
float sample_spacing(const RenderSettings& settings) {
  return std::max(0.125f, 1.f / std::sqrt(static_cast<float>(std::max(settings.samples, 1))));
}

}  // namespace

RenderContext::RenderContext(const RenderInput& input, const RenderSettings& wanted,
                             Diagnostics& diagnostics)
    : scene(*input.scene),
      environment(input.environment),
      settings(wanted),
      camera(input.camera, wanted.width, wanted.height, sample_spacing(wanted),
             input.camera_motion),
      geometry(scene,
               {wanted.time, wanted.frame, wanted.shutter_open, wanted.shutter_close, wanted.fps}),
      bvh(scene, diagnostics) {
  assert(input.shaders.size() == scene.meshes.size());
  if (environment != nullptr && !(environment->mean_luminance() > 0.f)) environment = nullptr;
  collect_materials(input);
  find_bounds();
  if (any_volume) camera_media = volumes_around(*this, input.camera.position, 0.f);
  collect_lights();
  point_lights = input.lights;
  choose_chances();
}

/// Alike for each kind that there is.
void RenderContext::choose_chances() {
  const int kinds =
      (environment != nullptr ? 1 : 0) + (lights.empty() ? 0 : 1) + (point_lights.empty() ? 0 : 1);
  const float each = kinds == 0 ? 0.f : 1.f / static_cast<float>(kinds);
  environment_chance = environment != nullptr ? each : 0.f;
  area_chance = lights.empty() ? 0.f : each;
  point_chance = point_lights.empty() ? 0.f : each;
}

void RenderContext::collect_materials(const RenderInput& input) {
  for (std::uint32_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
    const Mesh& m = scene.meshes[mesh];
    any_matte = any_matte || m.matte;
    const Shader* front = input.shaders[mesh];
    const Shader* back = input.back_shaders.empty() ? nullptr : input.back_shaders[mesh];
    if (m.light_radiance) {
      own_shaders_.push_back(
          std::make_unique<ConstantEmitter>(*m.light_radiance, m.light_two_sided));
      front = own_shaders_.back().get();
      back = nullptr;
    }
    assert(front != nullptr);
    front_materials.push_back(add_material(*front));
    back_materials.push_back(back == nullptr ? front_materials.back() : add_material(*back));
  }
}

std::uint32_t RenderContext::add_material(const Shader& shader) {
  const auto [slot, fresh] =
      known_.try_emplace(&shader, static_cast<std::uint32_t>(materials.size()));
  if (!fresh) return slot->second;
  Capabilities capabilities = shader.capabilities();
  any_opacity = any_opacity || capabilities.has_opacity;
  any_volume = any_volume || capabilities.is_volume;
  any_media = any_media || capabilities.has_interior || capabilities.has_subsurface ||
              capabilities.is_volume;
  state_bytes = std::max(state_bytes, shader.state_bytes(settings.batch_size));
  primvars = std::max(primvars, capabilities.primvars.size());
  const bool has_subsurface = capabilities.has_subsurface;
  materials.push_back({&shader, std::move(capabilities)});
  const std::uint32_t index = slot->second;
  if (has_subsurface) {
    own_shaders_.push_back(std::make_unique<ExitShader>(shader));
    const std::uint32_t exit = add_material(*own_shaders_.back());
    materials[index].exit = exit;
  }
  return index;
}

/// Looks at volumes that vary at points all over the boxes of their meshes. What lies between may
/// be denser by a quarter.
void RenderContext::find_bounds() {
  constexpr int steps = 24;
  bounds.assign(scene.meshes.size(), 0.f);
  if (!any_volume) return;
  BatchBuffer buffer(settings.batch_size, 0, primvars);
  buffer.batch.time = settings.time;
  buffer.batch.frame = settings.frame;
  std::vector<InnerPoint> points;
  for (std::uint32_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
    const Material& material = materials[front_materials[mesh]];
    if (!material.capabilities.volume_varies) continue;
    const Bounds box = vertex_bounds(scene.meshes[mesh]);
    const Vec3 size = box.high - box.low;
    const auto ask = [&] {
      geometry.fill_within(points, material.capabilities, camera, buffer);
      material.shader->volume(buffer.batch, buffer.within);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const float density = max_component(load(buffer.within.medium.absorption, i) +
                                            load(buffer.within.medium.scattering, i));
        if (std::isfinite(density)) bounds[mesh] = std::max(bounds[mesh], 1.25f * density);
      }
      points.clear();
    };
    for (int i = 0; i < steps * steps * steps; ++i) {
      const Vec3 share = {(static_cast<float>(i % steps) + 0.5f) / steps,
                          (static_cast<float>(i / steps % steps) + 0.5f) / steps,
                          (static_cast<float>(i / (steps * steps)) + 0.5f) / steps};
      const Vec3 own = box.low + share * size;
      const Vec3 P = scene.meshes[mesh].instances.empty()
                         ? own
                         : transform_point(scene.meshes[mesh].instances[0].at(0.f), own);
      points.push_back({mesh, 0, 0.f, P, {0.f, 0.f, 1.f}});
      if (points.size() == settings.batch_size) ask();
    }
    if (!points.empty()) ask();
  }
}

void RenderContext::collect_lights() {
  BatchBuffer buffer(settings.batch_size, 0, primvars);
  buffer.batch.time = settings.time;
  buffer.batch.frame = settings.frame;
  for (std::uint32_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
    const bool emits = materials[front_materials[mesh]].capabilities.emits ||
                       materials[back_materials[mesh]].capabilities.emits;
    // What nothing sees is no light either (Geometry Extensions, "Visibility Elements").
    if (!emits || scene.meshes[mesh].visible_to == 0) continue;
    // What moves is found by paths alone: how large its triangles are is a matter of the time.
    if (!scene.meshes[mesh].instances.empty()) continue;
    // And of fibres: their pieces are no triangles.
    if (scene.meshes[mesh].is_fibres()) continue;
    lights.add(scene, mesh, triangle_luminance(mesh, buffer));
  }
  lights.finish();
}

/// The larger of the mean luminances that leave the two sides of each triangle
/// perpendicularly, from its centroid and three points halfway to the corners.
std::vector<float> RenderContext::triangle_luminance(std::uint32_t mesh,
                                                     BatchBuffer& buffer) const {
  std::vector<float> result(scene.meshes[mesh].triangles.size(), 0.f);
  for (const bool back : {false, true}) brighten(result, mesh, back, buffer);
  // Where the probes saw nothing a texture may still glow: keep some chance there.
  const float brightest = *std::max_element(result.begin(), result.end());
  for (float& l : result) l = std::max(l, 0.02f * brightest);
  return result;
}

/// Raises the luminance of each triangle to that of its front or back.
void RenderContext::brighten(std::vector<float>& luminances, std::uint32_t mesh, bool back,
                             BatchBuffer& buffer) const {
  constexpr float probes[4][2] = {{1.f / 3.f, 1.f / 3.f},
                                  {1.f / 6.f, 1.f / 6.f},
                                  {2.f / 3.f, 1.f / 6.f},
                                  {1.f / 6.f, 2.f / 3.f}};
  const Mesh& m = scene.meshes[mesh];
  const Material& material = materials[(back ? back_materials : front_materials)[mesh]];
  if (!material.capabilities.emits) return;
  std::vector<SurfacePoint> points;
  for (std::size_t first = 0; first < m.triangles.size();) {
    const std::size_t last =
        std::min(m.triangles.size(), first + std::max(1u, settings.batch_size / 4));
    points.clear();
    for (std::size_t t = first; t < last; ++t) {
      const auto triangle = static_cast<std::uint32_t>(t);
      const Vec3 n = surface_normal(scene, {.mesh = mesh, .triangle = triangle});
      for (const auto& [u, v] : probes) {
        points.push_back({mesh, triangle, u, v, back ? -n : n, false, 0.f, 0.f});
      }
    }
    geometry.fill(points, material.capabilities, camera, buffer);
    material.shader->emission(buffer.batch, buffer.rgb);
    for (std::size_t t = first; t < last; ++t) {
      float sum = 0.f;
      for (std::size_t i = 4 * (t - first); i < 4 * (t - first) + 4; ++i) {
        sum += 0.25f * std::max(0.f, luminance(load(buffer.rgb, i)));
      }
      luminances[t] = std::max(luminances[t], sum);
    }
    first = last;
  }
}

}  // namespace nacre::host
