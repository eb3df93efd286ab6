#include "examples/render/gltf_dropped.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace nacre::host {

namespace {

/// Extensions of materials and their images, of which nothing is read but names.
bool is_of_materials(std::string_view name) {
  return name.starts_with("KHR_materials_") || name.starts_with("KHR_texture_") ||
         name.starts_with("EXT_texture_");
}

/// Honoured, or without a part in the picture.
bool is_harmless(std::string_view name) {
  return name == "KHR_mesh_quantization" || name == "EXT_mesh_gpu_instancing" ||
         name == "KHR_xmp" || name == "KHR_xmp_json_ld" || name == "FB_ngon_encoding";
}

}  // namespace

void GltfDropped::say(const char* code, const GltfValue& where, std::string message,
                      std::string expected, std::string found) {
  if (!said_.insert(code).second) return;
  where.report().warning(code, where.path(), std::move(message), std::move(expected),
                         std::move(found));
}

bool GltfDropped::look_at_file(const GltfValue& root) {
  bool ok = true;
  const GltfValue required = root["extensionsRequired"];
  for (std::size_t i = 0; i < required.size(); ++i) {
    const auto name = required[i].text();
    ok = ok && name;
    // Where shading comes from a document, the scene's own need not be understood.
    if (!name || is_harmless(*name) || is_of_materials(*name)) continue;
    ok = false;
    required[i].error("the scene requires an extension that is not supported",
                      "KHR_mesh_quantization, EXT_mesh_gpu_instancing, or one of materials",
                      required[i].shown());
  }
  const GltfValue materials = root["materials"];
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const auto names = materials[i].names();
    const bool shades = std::any_of(names.begin(), names.end(), [](const std::string& name) {
      return name != "name" && name != "extras";
    });
    if (!shades) continue;
    say("scene-materials-not-rendered", materials[i],
        "what the scene's materials say of shading is not rendered; only their names count",
        "materials of the document", fmt::format("{} materials", materials.size()));
  }
  return ok;
}

void GltfDropped::look_at_node(const GltfValue& node) {
  if (node["skin"]) {
    say("skins-not-rendered", node["skin"],
        "skins are not rendered: the mesh stands as it is stored");
  }
  if (node["weights"].size() != 0) {
    say("morphs-not-rendered", node["weights"],
        "morph targets are not rendered: the mesh stands as it is stored");
  }
  look_at_extensions(node["extensions"]);
}

void GltfDropped::look_at_primitive(const GltfValue& primitive) {
  if (primitive["targets"].size() != 0) {
    say("morphs-not-rendered", primitive["targets"],
        "morph targets are not rendered: the mesh stands as it is stored");
  }
  look_at_extensions(primitive["extensions"]);
}

void GltfDropped::look_at_extensions(const GltfValue& extensions) {
  for (const std::string& name : extensions.names()) {
    const GltfValue extension = extensions[name.c_str()];
    if (name == "KHR_lights_punctual" || is_harmless(name) || is_of_materials(name)) continue;
    if (!said_.insert(name).second) continue;
    extension.report().warning("extension-not-rendered", extension.path(),
                               "an extension is not supported and left out", {}, name);
  }
}

}  // namespace nacre::host
