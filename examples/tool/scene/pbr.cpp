#include "examples/tool/scene/pbr.h"

#include <algorithm>
#include <vector>

#include "examples/tool/scene/nodes.h"

namespace nacre::tool {

namespace {

using host::SceneMaterial;
using host::SceneTexture;
using host::Textured;

bool is_black(const SceneMaterial::Color& c) { return c == SceneMaterial::Color{0.f, 0.f, 0.f}; }

/// A number, or a channel of its texture times it.
Port number(SceneNodes& nodes, const Textured<float>& of, int channel) {
  return of.texture ? nodes.channel(*of.texture, channel, of.value) : port(of.value);
}

Port color(SceneNodes& nodes, const Textured<SceneMaterial::Color>& of) {
  const Port factor = port(of.value);
  return of.texture ? nodes.multiply(nodes.image(*of.texture, "color3", true), factor) : factor;
}

/// The colour that a texture, a factor and the vertices make together, and its alpha.
struct BaseColor {
  Port color, alpha;
};

BaseColor base_color(SceneNodes& nodes, const SceneMaterial& m, bool has_colors) {
  const auto& [f, texture] = m.base_color;
  const bool is_opaque = m.alpha == SceneMaterial::Alpha::opaque;
  if (is_opaque || (!texture && !has_colors)) {
    const std::array<float, 3> rgb{f[0], f[1], f[2]};
    Port result = color(nodes, {rgb, texture});
    if (has_colors) result = nodes.multiply(nodes.add("geomcolor", "color3", {}), result);
    return {result, port(is_opaque ? 1.f : f[3])};
  }
  Port all = port(f);
  if (texture) all = nodes.multiply(nodes.image(*texture, "color4", true), all);
  if (has_colors) all = nodes.multiply(nodes.add("geomcolor", "color4", {}), all);
  return {nodes.add("convert", "color3", {{"in", all}}), nodes.extract(all, 3)};
}

/// glTF 2.0, 3.9.3: x and y of what a normal map has are scaled.
Port normal(SceneNodes& nodes, const Textured<float>& map) {
  std::vector<std::pair<std::string_view, Port>> inputs{
      {"in", nodes.image(*map.texture, "vector3", false)}};
  if (map.value != 1.f) inputs.emplace_back("scale", port(map.value));
  return nodes.add("normalmap", "vector3", inputs);
}

/// glTF 2.0, 3.9.2, or KHR_materials_pbrSpecularGlossiness: what is reflected straight on is
/// its specular colour, 0.04 times ours at an index of 1.5, and what is not reflected is diffuse.
void feed_base(SceneNodes& nodes, Element& shader, const SceneMaterial& m) {
  if (!m.glossy) {
    Port metallic = port(m.metallic), roughness = port(m.roughness);
    if (const auto& map = m.metallic_roughness) {
      metallic = nodes.channel(*map, 2, m.metallic);
      roughness = nodes.channel(*map, 1, m.roughness);
    }
    nodes.feed(shader, "metallic", metallic);
    nodes.feed(shader, "roughness", roughness);
    nodes.feed(shader, "ior", port(m.ior));
    return;
  }
  SceneMaterial::Color specular = m.glossy->specular;
  for (float& each : specular) each *= 25.f;
  Textured<SceneMaterial::Color> of{specular, m.glossy->texture};
  Port smooth = port(m.glossy->glossiness);
  if (of.texture) smooth = nodes.alpha(*of.texture, true, m.glossy->glossiness);
  nodes.feed(shader, "metallic", port(0.f));
  nodes.feed(shader, "roughness",
             smooth.is_value()
                 ? port(1.f - m.glossy->glossiness)
                 : nodes.add("subtract", "float", {{"in1", port(1.f)}, {"in2", smooth}}));
  nodes.feed(shader, "specular_color", color(nodes, of));
}

void feed_specular(SceneNodes& nodes, Element& shader, const SceneMaterial& m) {
  if (m.glossy) return;
  const auto& specular = m.specular;
  if (specular.texture || specular.value != 1.f) {
    nodes.feed(shader, "specular",
               specular.texture ? nodes.alpha(*specular.texture, false, specular.value)
                                : port(specular.value));
  }
  const bool is_white = m.specular_color.value == SceneMaterial::Color{1.f, 1.f, 1.f};
  if (m.specular_color.texture || !is_white) {
    nodes.feed(shader, "specular_color", color(nodes, m.specular_color));
  }
}

void feed_coats(SceneNodes& nodes, Element& shader, const SceneMaterial& m) {
  if (m.transmission.value > 0.f) {
    nodes.feed(shader, "transmission", number(nodes, m.transmission, 0));
  }
  if (m.clearcoat.value > 0.f) {
    nodes.feed(shader, "clearcoat", number(nodes, m.clearcoat, 0));
    nodes.feed(shader, "clearcoat_roughness", number(nodes, m.clearcoat_roughness, 1));
    if (m.clearcoat_normal.texture) {
      nodes.feed(shader, "clearcoat_normal", normal(nodes, m.clearcoat_normal));
    }
  }
  if (!is_black(m.sheen_color.value)) {
    nodes.feed(shader, "sheen_color", color(nodes, m.sheen_color));
    const auto& rough = m.sheen_roughness;
    nodes.feed(shader, "sheen_roughness",
               rough.texture ? nodes.alpha(*rough.texture, false, rough.value) : port(rough.value));
  }
}

void feed_iridescence(SceneNodes& nodes, Element& shader, const SceneMaterial& m) {
  if (!(m.iridescence.value > 0.f)) return;
  nodes.feed(shader, "iridescence", number(nodes, m.iridescence, 0));
  nodes.feed(shader, "iridescence_ior", port(m.iridescence_ior));
  const auto& thickness = m.iridescence_thickness;
  Port nanometres = port(thickness.value);
  if (thickness.texture) {
    nanometres = nodes.add("mix", "float",
                           {{"bg", port(m.iridescence_least)},
                            {"fg", port(thickness.value)},
                            {"mix", nodes.channel(*thickness.texture, 1, 1.f)}});
  }
  nodes.feed(shader, "iridescence_thickness", nanometres);
}

/// KHR_materials_anisotropy: red and green are a direction in [-1, 1], blue is the strength.
void feed_anisotropy(SceneNodes& nodes, Element& shader, const SceneMaterial& m) {
  if (!(m.anisotropy.value > 0.f)) return;
  nodes.feed(shader, "anisotropy_strength", number(nodes, m.anisotropy, 2));
  Port rotation = port(m.anisotropy_rotation);
  if (const auto& texture = m.anisotropy.texture) {
    const auto signed_channel = [&](int index) {
      const Port twice = nodes.multiply(nodes.channel(*texture, index, 1.f), port(2.f));
      return nodes.add("subtract", "float", {{"in1", twice}, {"in2", port(1.f)}});
    };
    const Port angle =
        nodes.add("atan2", "float", {{"iny", signed_channel(1)}, {"inx", signed_channel(0)}});
    rotation = nodes.add("add", "float", {{"in1", angle}, {"in2", rotation}});
  }
  nodes.feed(shader, "anisotropy_rotation", rotation);
}

void feed_emission(SceneNodes& nodes, Element& shader, const SceneMaterial& m) {
  if (is_black(m.emissive.value)) return;
  nodes.feed(shader, "emissive", color(nodes, m.emissive));
  nodes.feed(shader, "emissive_strength", port(m.emissive_strength));
}

void feed_alpha(SceneNodes& nodes, Element& shader, const SceneMaterial& m, const Port& alpha) {
  if (m.alpha == SceneMaterial::Alpha::opaque) return;
  const bool is_mask = m.alpha == SceneMaterial::Alpha::mask;
  nodes.feed(shader, "alpha", alpha);
  nodes.feed(shader, "alpha_mode", {"integer", "", is_mask ? "1" : "2"});
  if (is_mask) nodes.feed(shader, "alpha_cutoff", port(m.alpha_cutoff));
}

/// KHR_materials_volume: what has no thickness is a thin wall, as without that extension.
bool is_thin(const SceneMaterial& m) { return !m.volume || !(m.volume->thickness.value > 0.f); }

bool absorbs(const SceneMaterial& m) {
  return m.volume && m.volume->attenuation_distance &&
         m.volume->attenuation_color != SceneMaterial::Color{1.f, 1.f, 1.f};
}

GltfPbrNodes::Kind kind_of(const SceneMaterial& m) {
  if (!(m.transmission.value > 0.f)) return GltfPbrNodes::Kind::plain;
  if (is_thin(m)) return GltfPbrNodes::Kind::wall;
  return absorbs(m) ? GltfPbrNodes::Kind::volume : GltfPbrNodes::Kind::plain;
}

/// The distance is what light goes, so that the thickness, which is there for renderers that do not
/// know how far that is, does not count.
void feed_volume(SceneNodes& nodes, Element& shader, const SceneMaterial& m) {
  if (!absorbs(m)) return;
  nodes.feed(shader, "attenuation_distance", port(*m.volume->attenuation_distance));
  nodes.feed(shader, "attenuation_color", port(m.volume->attenuation_color));
}

/// KHR_materials_unlit: the base colour as it is, whatever light falls on it.
void feed_unlit(SceneNodes& nodes, Element& shader, const SceneMaterial& m, const BaseColor& base) {
  nodes.feed(shader, "emission_color", base.color);
  if (m.alpha == SceneMaterial::Alpha::opaque) return;
  Port opacity = base.alpha;
  if (m.alpha == SceneMaterial::Alpha::mask) {
    opacity = nodes.add("ifgreatereq", "float",
                        {{"value1", base.alpha},
                         {"value2", port(m.alpha_cutoff)},
                         {"in1", port(1.f)},
                         {"in2", port(0.f)}});
  }
  nodes.feed(shader, "opacity", opacity);
}

}  // namespace

void ScenePbr::add(const SceneMaterial& m, const std::string& name, bool has_colors) {
  SceneNodes nodes(document_, image_files_, document_.free_name("NG_" + name));
  const std::string shader_name = document_.free_name("SR_" + name);
  const GltfPbrNodes::Kind kind = kind_of(m);
  const std::string category = m.is_unlit ? "surface_unlit" : nodes_.category(kind);
  Element& shader = document_.make(category, shader_name, "surfaceshader");
  const BaseColor base = base_color(nodes, m, has_colors);
  if (m.is_unlit) {
    feed_unlit(nodes, shader, m, base);
  } else {
    nodes.feed(shader, "base_color", base.color);
    feed_base(nodes, shader, m);
    feed_alpha(nodes, shader, m, base.alpha);
    if (m.normal.texture) nodes.feed(shader, "normal", normal(nodes, m.normal));
    feed_specular(nodes, shader, m);
    feed_coats(nodes, shader, m);
    feed_iridescence(nodes, shader, m);
    feed_anisotropy(nodes, shader, m);
    feed_emission(nodes, shader, m);
    feed_volume(nodes, shader, m);
    warn_of_lacks(m, kind, category != "gltf_pbr");
  }
  nodes.finish();
  document_.append(document_.root(), shader);
  Element& material = document_.make("surfacematerial", name, "material");
  document_.append(document_.root(), material);
  document_.set(document_.add_input(material, "surfaceshader", "surfaceshader"), "nodename",
                shader_name);
}

void ScenePbr::warn(const SceneMaterial& material, const char* what, const char* instead) {
  if (!said_.insert(what).second) return;
  diagnostics_.warning("not-in-gltf-pbr", {scene_file_, 0, 0, {}},
                       std::string("MaterialX's gltf_pbr cannot express ") + what, instead,
                       "material '" + material.name + '\'');
}

void ScenePbr::warn_of_lacks(const SceneMaterial& m, GltfPbrNodes::Kind kind, bool is_that) {
  using Kind = GltfPbrNodes::Kind;
  if (kind == Kind::wall && !is_that) {
    warn(m, "transmission through a thin wall",
         "rendered as the surface of a solid, which bends light");
  }
  if (kind == Kind::volume && !is_that) warn(m, "attenuation in volumes", "rendered as clear");
  if (m.transmission.value > 0.f && !is_thin(m) && m.dispersion > 0.f) {
    warn(m, "dispersion", "rendered without");
  }
  const auto& set = m.normal.texture;
  if (set && set->set != 0) {
    warn(m, "a normal map along another uv set", "tangents of the first set");
  }
}

}  // namespace nacre::tool
