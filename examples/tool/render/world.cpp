#include "examples/tool/render/world.h"

#include "examples/render/builtin_scene.h"
#include "examples/render/camera.h"
#include "examples/render/load_scene.h"
#include "examples/tool/scene/materials.h"

namespace nacre::tool {

std::optional<host::Environment> load_environment(const RenderOptions& options,
                                                  Diagnostics& diagnostics) {
  constexpr float radians = 0.01745329252f;
  const float rotation = options.environment_rotation * radians;
  // Strategy::multiple_importance is the only one here.
  constexpr auto drawn = host::Environment::Drawn::above_mean;
  if (options.environment.empty()) {
    return host::Environment::studio(options.environment_scale, rotation, drawn);
  }
  return host::Environment::load(options.environment, options.environment_scale, rotation,
                                 options.common.texture_limits.limits, diagnostics, {}, drawn);
}

host::Scene load_world(const RenderOptions& options, Diagnostics& diagnostics) {
  if (options.scene.empty()) {
    host::check_looks({{}, options.variant, options.animation}, {}, diagnostics);
    return host::make_builtin_scene();
  }
  const host::RenderSettings& s = options.settings;
  const double time = static_cast<double>(s.time);
  const host::Shutter shutter{time + static_cast<double>(s.shutter_open),
                              time + static_cast<double>(s.shutter_close)};
  host::Scene loaded =
      host::load_scene(options.scene, options.scene_limits, diagnostics, shutter,
                       {has_own_materials(options), options.variant, options.animation});
  if (loaded.meshes.empty()) return loaded;
  if (loaded.cameras.empty()) {
    const float aspect = static_cast<float>(s.width) / static_cast<float>(s.height);
    loaded.cameras.push_back({"", host::fit_camera(host::bounds(loaded), aspect)});
  }
  if (options.ground) loaded.meshes.push_back(host::make_ground_below(loaded));
  return loaded;
}

host::Camera with_lens(const RenderOptions& options, const host::SceneCamera& camera) {
  host::Camera result = camera.camera;
  result.lens_radius = options.lens_radius;
  if (options.focus_distance > 0.0f) result.focus_distance = options.focus_distance;
  return result;
}

}  // namespace nacre::tool
