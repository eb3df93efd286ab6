#include "examples/render/gltf_material.h"

#include <limits>
#include <string_view>

namespace nacre::host {

namespace {

constexpr double largest = 1e6;

/// What two of KHR's extensions say of the same material, and the core, in terms of one another.
class Reader {
 public:
  Reader(GltfTextures& textures) : textures_(textures) {}

  float number(const GltfValue& value, float otherwise, double high = 1.0, double low = 0.0) const {
    return value.within(low, high, otherwise).value_or(otherwise);
  }

  template <std::size_t n>
  std::array<float, n> color(const GltfValue& value, std::array<float, n> otherwise,
                             double high = 1.0) const {
    if (!value.numbers(n)) return otherwise;
    for (std::size_t i = 0; i < n; ++i) otherwise[i] = number(value[i], otherwise[i], high);
    return otherwise;
  }

  Textured<float> textured(const GltfValue& of, const char* factor, const char* texture,
                           float otherwise, double high = 1.0) {
    return {number(of[factor], otherwise, high), textures_.read(of[texture])};
  }

  template <std::size_t n>
  Textured<std::array<float, n>> textured(const GltfValue& of, const char* factor,
                                          const char* texture, std::array<float, n> otherwise,
                                          double high = 1.0) {
    return {color(of[factor], otherwise, high), textures_.read(of[texture])};
  }

  /// A normal map: its scale may be anything.
  Textured<float> normal(const GltfValue& info) {
    return {number(info["scale"], 1.f, largest, -largest), textures_.read(info)};
  }

  std::optional<SceneTexture> texture(const GltfValue& info) { return textures_.read(info); }

 private:
  GltfTextures& textures_;
};

void read_core(const GltfValue& m, Reader& reader, SceneMaterial& to) {
  const GltfValue pbr = m["pbrMetallicRoughness"];
  to.base_color =
      reader.textured<4>(pbr, "baseColorFactor", "baseColorTexture", {1.f, 1.f, 1.f, 1.f});
  to.metallic = reader.number(pbr["metallicFactor"], 1.f);
  to.roughness = reader.number(pbr["roughnessFactor"], 1.f);
  to.metallic_roughness = reader.texture(pbr["metallicRoughnessTexture"]);
  to.normal = reader.normal(m["normalTexture"]);
  to.emissive = reader.textured<3>(m, "emissiveFactor", "emissiveTexture", {0.f, 0.f, 0.f});
  to.two_sided = m["doubleSided"].boolean().value_or(false);
  to.alpha_cutoff = reader.number(m["alphaCutoff"], 0.5f, largest);
  const GltfValue mode = m["alphaMode"];
  const std::string alpha = mode.text().value_or("OPAQUE");
  if (alpha == "MASK") {
    to.alpha = SceneMaterial::Alpha::mask;
  } else if (alpha == "BLEND") {
    to.alpha = SceneMaterial::Alpha::blend;
  } else if (alpha != "OPAQUE") {
    mode.error("there is no such alpha mode", "\"OPAQUE\", \"MASK\" or \"BLEND\"", mode.shown());
  }
}

/// False where the extension is not known.
bool read_extension(std::string_view name, const GltfValue& e, Reader& reader, SceneMaterial& to) {
  if (name == "KHR_materials_unlit") {
    to.is_unlit = true;
  } else if (name == "KHR_materials_emissive_strength") {
    to.emissive_strength = reader.number(e["emissiveStrength"], 1.f, 1e30);
  } else if (name == "KHR_materials_ior") {
    // 0 stands for an index without end: all is reflected as specular_color says.
    to.ior = reader.number(e["ior"], 1.5f, largest);
  } else if (name == "KHR_materials_specular") {
    to.specular = reader.textured(e, "specularFactor", "specularTexture", 1.f);
    to.specular_color = reader.textured<3>(e, "specularColorFactor", "specularColorTexture",
                                           {1.f, 1.f, 1.f}, largest);
  } else if (name == "KHR_materials_transmission") {
    to.transmission = reader.textured(e, "transmissionFactor", "transmissionTexture", 0.f);
  } else if (name == "KHR_materials_volume") {
    auto& volume = to.volume.emplace(SceneMaterial::Volume{});  // Clang 19 asks for the braces.
    volume.thickness = reader.textured(e, "thicknessFactor", "thicknessTexture", 0.f, 1e30);
    if (e["attenuationDistance"]) {
      volume.attenuation_distance = reader.number(e["attenuationDistance"], 1.f, 1e30, 1e-30);
    }
    volume.attenuation_color = reader.color<3>(e["attenuationColor"], {1.f, 1.f, 1.f});
  } else if (name == "KHR_materials_clearcoat") {
    to.clearcoat = reader.textured(e, "clearcoatFactor", "clearcoatTexture", 0.f);
    to.clearcoat_roughness =
        reader.textured(e, "clearcoatRoughnessFactor", "clearcoatRoughnessTexture", 0.f);
    to.clearcoat_normal = reader.normal(e["clearcoatNormalTexture"]);
  } else if (name == "KHR_materials_sheen") {
    to.sheen_color =
        reader.textured<3>(e, "sheenColorFactor", "sheenColorTexture", {0.f, 0.f, 0.f});
    to.sheen_roughness = reader.textured(e, "sheenRoughnessFactor", "sheenRoughnessTexture", 0.f);
  } else if (name == "KHR_materials_iridescence") {
    to.iridescence = reader.textured(e, "iridescenceFactor", "iridescenceTexture", 0.f);
    to.iridescence_ior = reader.number(e["iridescenceIor"], 1.3f, largest, 1.0);
    to.iridescence_least = reader.number(e["iridescenceThicknessMinimum"], 100.f, largest);
    to.iridescence_thickness = reader.textured(e, "iridescenceThicknessMaximum",
                                               "iridescenceThicknessTexture", 400.f, largest);
  } else if (name == "KHR_materials_anisotropy") {
    to.anisotropy = reader.textured(e, "anisotropyStrength", "anisotropyTexture", 0.f);
    to.anisotropy_rotation = reader.number(e["anisotropyRotation"], 0.f, largest, -largest);
  } else if (name == "KHR_materials_dispersion") {
    to.dispersion = reader.number(e["dispersion"], 0.f, largest);
  } else if (name == "KHR_materials_pbrSpecularGlossiness") {
    to.base_color = reader.textured<4>(e, "diffuseFactor", "diffuseTexture", {1.f, 1.f, 1.f, 1.f});
    to.glossy = SceneMaterial::Glossy{reader.color<3>(e["specularFactor"], {1.f, 1.f, 1.f}),
                                      reader.number(e["glossinessFactor"], 1.f),
                                      reader.texture(e["specularGlossinessTexture"])};
  } else {
    return false;
  }
  return true;
}

}  // namespace

SceneMaterial read_material(const GltfValue& material, GltfTextures& textures,
                            GltfDropped& dropped) {
  SceneMaterial result;
  Reader reader(textures);
  result.name = material.name();
  read_core(material, reader, result);
  const GltfValue extensions = material["extensions"];
  for (const std::string& name : extensions.names()) {
    const GltfValue extension = extensions[name.c_str()];
    if (read_extension(name, extension, reader, result)) continue;
    dropped.look_at_extension(name, extension);
  }
  return result;
}

}  // namespace nacre::host
