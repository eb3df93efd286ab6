#include "examples/render/gltf_dropped.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace nacre::host {

namespace {

/// Extensions of materials and their images: of which, where shading comes from a document,
/// nothing is read but names.
bool is_of_materials(std::string_view name) {
  return name.starts_with("KHR_materials_") || name.starts_with("KHR_texture_") ||
         name.starts_with("EXT_texture_");
}

/// Those that read_material() and GltfTextures read.
bool is_read_material(std::string_view name) {
  constexpr std::string_view known[] = {"anisotropy",
                                        "clearcoat",
                                        "dispersion",
                                        "emissive_strength",
                                        "ior",
                                        "iridescence",
                                        "pbrSpecularGlossiness",
                                        "sheen",
                                        "specular",
                                        "transmission",
                                        "unlit",
                                        "variants",
                                        "volume"};
  constexpr std::string_view materials = "KHR_materials_";
  if (name == "KHR_texture_transform") return true;
  return name.starts_with(materials) &&
         std::ranges::find(known, name.substr(materials.size())) != std::end(known);
}

/// Honoured, or without a part in the picture.
bool is_harmless(std::string_view name) {
  return name == "KHR_mesh_quantization" || name == "EXT_mesh_gpu_instancing" ||
         name == "KHR_draco_mesh_compression" || name == "EXT_meshopt_compression" ||
         name == "KHR_lights_punctual" || name == "KHR_xmp" || name == "KHR_xmp_json_ld" ||
         name == "FB_ngon_encoding";
}

}  // namespace

void GltfDropped::say(const char* code, const GltfValue& where, std::string message,
                      std::string expected, std::string found) {
  if (!said_.insert(code).second) return;
  where.report().warning(code, where.path(), std::move(message), std::move(expected),
                         std::move(found));
}

bool GltfDropped::look_at_file(const GltfValue& root, bool reads_materials) {
  bool ok = true;
  const GltfValue required = root["extensionsRequired"];
  for (std::size_t i = 0; i < required.size(); ++i) {
    const auto name = required[i].text();
    ok = ok && name;
    // Where shading comes from a document, the scene's own need not be understood.
    if (!name || is_harmless(*name)) continue;
    if (reads_materials ? is_read_material(*name) : is_of_materials(*name)) continue;
    ok = false;
    required[i].error("the scene requires an extension that is not supported",
                      "KHR_mesh_quantization, EXT_mesh_gpu_instancing, KHR_draco_mesh_compression, "
                      "EXT_meshopt_compression, KHR_lights_punctual, or one of materials",
                      required[i].shown());
  }
  if (reads_materials) return ok;
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

void GltfDropped::look_at_node(const GltfValue& node) { look_at_extensions(node["extensions"]); }

void GltfDropped::look_at_primitive(const GltfValue& primitive) {
  look_at_extensions(primitive["extensions"]);
}

void GltfDropped::look_at_extensions(const GltfValue& extensions) {
  for (const std::string& name : extensions.names()) {
    const GltfValue extension = extensions[name.c_str()];
    if (is_harmless(name) || is_of_materials(name)) continue;
    look_at_extension(name, extension);
  }
}

void GltfDropped::look_at_extension(const std::string& name, const GltfValue& extension) {
  if (!said_.insert(name).second) return;
  extension.report().warning("extension-not-rendered", extension.path(),
                             "an extension is not supported and left out", {}, name);
}

}  // namespace nacre::host
