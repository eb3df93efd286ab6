#include "examples/render/load_scene.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace nacre::host {

namespace {

std::string lower_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace

bool has_materials(const std::string& path) {
  const std::string extension = lower_extension(path);
  return extension == ".glb" || extension == ".gltf";
}

bool check_looks(const SceneLooks& looks, const std::string& path, Diagnostics& diagnostics) {
  if (!looks.animation.empty()) {
    diagnostics.error("unknown-animation", {path, 0, 0, {}}, "the scene has no animations",
                      "a glTF file with animations", '"' + looks.animation + '"');
    return false;
  }
  if (!looks.variant.empty()) {
    diagnostics.error("unknown-variant", {path, 0, 0, {}}, "the scene has no variants",
                      "a glTF file with KHR_materials_variants", '"' + looks.variant + '"');
    return false;
  }
  return true;
}

Scene load_scene(const std::string& path, const SceneLimits& limits, Diagnostics& diagnostics,
                 const Shutter& shutter, const SceneLooks& looks) {
  const std::string extension = lower_extension(path);
  if (has_materials(path)) return load_gltf(path, limits, diagnostics, shutter, looks);
  if (!check_looks(looks, path, diagnostics)) return {};
  if (extension == ".obj") return load_obj(path, limits, diagnostics);
  if (extension == ".hair") return load_hair(path, limits, diagnostics);
  diagnostics.error("unknown-scene-format", {path, 0, 0, {}}, "cannot tell the format of the scene",
                    "a name ending in .glb, .gltf, .hair or .obj", "\"" + extension + "\"");
  return {};
}

}  // namespace nacre::host
