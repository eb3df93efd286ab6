#include "examples/render/gltf_variants.h"

namespace nacre::host {

namespace {

constexpr const char* extension = "KHR_materials_variants";

}  // namespace

bool GltfVariants::choose(const std::string& name) {
  if (name.empty()) return true;
  const GltfValue variants = root_["extensions"][extension]["variants"];
  std::string names;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    const std::string each = variants[i].name();
    if (each == name) return chosen_ = i, true;
    names += (names.empty() ? "" : ", ") + each;
  }
  root_.report().diagnostics.error(
      "unknown-variant", variants.location(), "the scene has no variant of that name",
      names.empty() ? "a file with KHR_materials_variants" : "one of " + names, '"' + name + '"');
  return false;
}

GltfValue GltfVariants::material_of(const GltfValue& primitive) const {
  const GltfValue mappings = primitive["extensions"][extension]["mappings"];
  for (std::size_t i = 0; chosen_ && i < mappings.size(); ++i) {
    const GltfValue variants = mappings[i]["variants"];
    for (std::size_t k = 0; k < variants.size(); ++k) {
      if (variants[k].count() == chosen_) return mappings[i]["material"];
    }
  }
  return primitive["material"];
}

}  // namespace nacre::host
