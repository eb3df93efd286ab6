#include "tests/fuzz/scene_host.h"

#include <algorithm>

#include "examples/render/camera.h"
#include "examples/render/load_scene.h"
#include "examples/render/render.h"
#include "tests/examples/render/test_shaders.h"
#include "tests/fuzz/host.h"

namespace nacre::fuzz {

namespace {

void render_from(const host::Scene& scene, const host::SceneCamera& camera) {
  static const host::LambertShader grey({0.5f, 0.5f, 0.5f});
  static const host::Environment sky = host::Environment::constant({1.f, 1.f, 1.f});
  host::RenderInput input;
  input.scene = &scene;
  input.shaders.assign(scene.meshes.size(), &grey);
  input.environment = &sky;
  input.camera = camera.camera;
  input.camera_motion = camera.motion;
  host::RenderSettings settings;
  settings.width = settings.height = 4;
  settings.samples = 2;
  settings.max_depth = 2;
  settings.threads = 1;
  settings.shutter_close = 1.f;
  Diagnostics diagnostics;
  const auto film = host::render(input, settings, diagnostics);
  if (film.has_value() == diagnostics.has_errors()) {
    fail("a render ends without a picture or a reason, or with both");
  }
}

}  // namespace

void render_scene(const std::string& path) {
  Diagnostics diagnostics;
  const host::Scene scene = host::load_scene(path, {}, diagnostics, {0, 1}, {.materials = true});
  if (scene.meshes.empty() != diagnostics.has_errors()) {
    fail("a scene is refused without a reason, or read with an error");
  }
  if (scene.meshes.empty()) return;
  constexpr std::size_t most = 2;
  for (std::size_t i = 0; i < std::min(most, scene.cameras.size()); ++i) {
    render_from(scene, scene.cameras[i]);
  }
  render_from(scene, {"", host::fit_camera(host::bounds(scene), 1.f)});
}

}  // namespace nacre::fuzz
