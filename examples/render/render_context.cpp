#include "examples/render/render_context.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "examples/render/area_light.h"
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
      bvh(input.bvh != nullptr ? *input.bvh : own_bvh.emplace(scene, diagnostics)) {
  assert(input.shaders.size() == scene.meshes.size());
  solids_ = input.solids;
  any_nested = !solids_.empty();
  assert(!any_nested || solids_.size() == scene.meshes.size());
  assert(settings.strategy != Strategy::light_only || environment == nullptr ||
         environment->draws_all());
  if (environment != nullptr && !(environment->mean_luminance() > 0.f)) environment = nullptr;
  collect_materials(input);
  find_bounds();
  if (any_volume || any_nested) camera_media = volumes_around(*this, input.camera.position, 0.f);
  point_lights = input.lights;
  lights = SceneLights(*this);
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

}  // namespace nacre::host
