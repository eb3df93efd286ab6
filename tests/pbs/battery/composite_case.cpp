#include "tests/pbs/battery/composite_trial.h"
#include "tests/support/material_text.h"

namespace nacre {

namespace {

using Values = std::vector<std::string>;

CompositeAxis real(std::string name, Values values) {
  return {std::move(name), "float", std::move(values)};
}
CompositeAxis shade(std::string name, Values values) {
  return {std::move(name), "color3", std::move(values)};
}
CompositeAxis truth(std::string name) { return {std::move(name), "boolean", {"false", "true"}}; }

const Values shares{"0", "0.3", "1"};
// Needles have a domain of their own: narrow_case.cpp.
const Values roughnesses{"0", "0.2", "0.3", "0.6", "1"};
const Values rough{"0.2", "0.3", "0.6", "1"};
const Values anisotropies{"0", "0.5", "0.95", "1"};
/// Of OpenPBR, whose 1 is a roughness of 0 across.
const Values some_anisotropies{"0", "0.5", "0.9"};
const Values indices{"1",    "1.000001", "0.999999", "1.001", "0.999", "0.667",
                     "1.05", "1.33",     "1.5",      "2.5",   "40"};
const Values films{"0", "0.001", "1", "30", "550", "5000", "1000000"};  // nm
const Values micrometres{"0", "0.000001", "0.001", "0.03", "0.55", "5"};
const Values colours{"0.8, 0.8, 0.8", "0.9, 0.3, 0.05", "1, 1, 1", "0, 0, 0"};
const Values white{"1, 1, 1"};
const Values alphas{"0, 0", "0.01, 0.01", "0.1, 0.1",  "0.4, 0.4",
                    "1, 1", "0.4, 0.1",   "0.01, 0.3", "1, 0.05"};

std::string shader(std::string_view category) {
  return element(category, "surfaceshader", "S", "{}");
}
std::string paper(std::string_view name) {
  return element(
      "oren_nayar_diffuse_bsdf", "BSDF", name,
      value_of("color", "color3", "0.8, 0.5, 0.3") + value_of("roughness", "float", "0.4"));
}
std::string metal(std::string_view name) {
  return element("conductor_bsdf", "BSDF", name, value_of("roughness", "vector2", "0.3, 0.1"));
}
std::string mode(std::string_view value) { return value_of("scatter_mode", "string", value); }
std::string layer(std::string_view top, std::string_view base) {
  return element("layer", "BSDF", "b", from("top", "BSDF", top) + from("base", "BSDF", base));
}

const std::vector<CompositeAxis> facets{{"roughness", "vector2", alphas},
                                        real("thinfilm_thickness", films),
                                        real("thinfilm_ior", {"1.3", "2"}),
                                        real("ior", indices)};

/// A surface of its own, for what only a surface says.
std::string thin_sheet() {
  return element("dielectric_bsdf", "BSDF", "top", "{}" + mode("R")) +
         element("dielectric_bsdf", "BSDF", "through", "{}" + mode("T")) +
         element("translucent_bsdf", "BSDF", "cloth",
                 value_of("color", "color3", "0.7, 0.6, 0.5")) +
         element("mix", "BSDF", "below",
                 from("fg", "BSDF", "cloth") + from("bg", "BSDF", "through") +
                     value_of("mix", "float", "0.5")) +
         layer("top", "below") +
         element("surface", "surfaceshader", "S",
                 from("bsdf", "BSDF", "b") + value_of("thin_walled", "boolean", "true"));
}

std::vector<Composite> make_composites() {
  return {
      {.name = "standard_surface",
       .nodes = shader("standard_surface"),
       .axes = {real("base", shares),
                shade("base_color", colours),
                real("metalness", shares),
                real("diffuse_roughness", shares),
                real("specular", shares),
                real("specular_roughness", roughnesses),
                real("specular_IOR", indices),
                real("specular_anisotropy", anisotropies),
                real("specular_rotation", {"0", "0.1"}),
                real("transmission", shares),
                real("subsurface", {"0", "0", "1"}),
                real("sheen", shares),
                real("sheen_roughness", roughnesses),
                real("coat", shares),
                real("coat_roughness", roughnesses),
                real("coat_anisotropy", anisotropies),
                shade("coat_color", colours),
                real("thin_film_thickness", films),
                real("thin_film_IOR", {"1.3", "2"}),
                truth("thin_walled")},
       .has_inside = true,
       // Measured where a thin wall with a film is seen from behind: 0.058.
       .albedo_error = 7e-2},
      {.name = "open_pbr_surface",
       .nodes = shader("open_pbr_surface"),
       .axes = {real("base_weight", shares),
                shade("base_color", colours),
                real("base_metalness", shares),
                real("base_diffuse_roughness", shares),
                real("specular_weight", shares),
                real("specular_roughness", roughnesses),
                real("specular_ior", indices),
                real("specular_roughness_anisotropy", some_anisotropies),
                real("transmission_weight", shares),
                real("subsurface_weight", {"0", "0", "1"}),
                real("fuzz_weight", shares),
                real("fuzz_roughness", roughnesses),
                real("coat_weight", shares),
                real("coat_roughness", roughnesses),
                real("coat_roughness_anisotropy", some_anisotropies),
                shade("coat_color", colours),
                real("coat_ior", {"1", "1.3", "1.6", "2.5"}),
                real("thin_film_weight", shares),
                real("thin_film_thickness", micrometres),
                truth("geometry_thin_walled"),
                real("geometry_opacity", {"1", "1", "0.4"})},
       .has_inside = true},
      {.name = "gltf_pbr",
       .nodes = shader("gltf_pbr"),
       .axes = {shade("base_color", colours), real("metallic", shares), real("roughness", rough),
                real("transmission", shares), real("specular", shares),
                shade("specular_color", colours), real("ior", indices), real("iridescence", shares),
                real("iridescence_thickness", films), shade("sheen_color", colours),
                real("sheen_roughness", roughnesses), real("clearcoat", shares),
                real("clearcoat_roughness", roughnesses), real("anisotropy_strength", anisotropies),
                real("dispersion", {"0", "1"})},
       .has_inside = true},
      {.name = "UsdPreviewSurface",
       .nodes = shader("UsdPreviewSurface"),
       .axes = {shade("diffuseColor", colours),
                {"useSpecularWorkflow", "integer", {"0", "1"}},
                shade("specularColor", {"0.04, 0.04, 0.04", "1, 0, 0", "1, 1, 1"}),
                real("metallic", shares),
                real("roughness", roughnesses),
                real("clearcoat", shares),
                real("clearcoatRoughness", roughnesses),
                real("ior", indices),
                real("opacity", {"1", "0.3", "0"})}},
      {.name = "disney_principled",
       .nodes = shader("disney_principled"),
       .axes = {shade("baseColor", colours), real("metallic", shares),
                real("roughness", roughnesses), real("anisotropic", anisotropies),
                real("specular", shares), real("specularTint", shares), real("sheen", shares),
                real("sheenTint", shares), real("clearcoat", shares),
                real("clearcoatGloss", shares), real("specTrans", shares), real("ior", indices),
                real("subsurface", shares)},
       .has_inside = true,
       .most_energy = 1.6,
       // Measured: 0.049, at 89.99 degrees, where the diffuse lobe gains.
       .albedo_error = 6e-2},
      {.name = "alSurface",
       .nodes = shader("alSurface"),
       .axes = {shade("diffuseColor", colours), real("diffuseRoughness", shares),
                real("backlightStrength", shares), real("sssMix", shares),
                real("specular1Roughness", roughnesses),
                real("specular1Anisotropy", {"0.2", "0.5", "0.8"}),
                real("specular1Ior", {"1", "1.4", "2.5", "40", "1000"}),
                real("specular2Strength", shares), real("specular2Roughness", roughnesses),
                real("transmissionStrength", shares), real("transmissionRoughness", roughnesses)},
       .has_inside = true,
       // Measured: 1.018, of anisotropic metal of index 40 and more.
       .most_energy = 1.025},
      {.name = "reflection_over_transmission",
       .nodes = element("dielectric_bsdf", "BSDF", "top", "{}" + mode("R")) +
                element("dielectric_bsdf", "BSDF", "base", "{}" + mode("T")) + layer("top", "base"),
       .axes = facets,
       .has_inside = true,
       // Measured over 120 configurations: 1.037, and 0.059; films at 89.99 degrees.
       .most_energy = 1.04,
       .albedo_error = 6.5e-2},
      {.name = "gloss_over_sheen_over_paper",
       .nodes = element("dielectric_bsdf", "BSDF", "top", "{}" + mode("R")) +
                element("sheen_bsdf", "BSDF", "sheen", value_of("mode", "string", "zeltner")) +
                paper("paper") +
                element("layer", "BSDF", "middle",
                        from("top", "BSDF", "sheen") + from("base", "BSDF", "paper")) +
                layer("top", "middle"),
       .axes = facets,
       // Measured: 0.055; a film on an index of 1 at 89 degrees.
       .albedo_error = 6.5e-2},
      {.name = "add",
       .nodes = element("dielectric_bsdf", "BSDF", "x",
                        "{}" + mode("RT") + value_of("weight", "float", "0.5")) +
                element("burley_diffuse_bsdf", "BSDF", "y", value_of("weight", "float", "0.3")) +
                element("add", "BSDF", "b", from("in1", "BSDF", "x") + from("in2", "BSDF", "y")),
       .axes = facets,
       .has_inside = true},
      {.name = "mix",
       .nodes = element("generalized_schlick_bsdf", "BSDF", "x",
                        "{}" + mode("RT") + value_of("color0", "color3", "0.04, 0.1, 0.3")) +
                metal("y") +
                element("mix", "BSDF", "b",
                        from("fg", "BSDF", "x") + from("bg", "BSDF", "y") +
                            value_of("mix", "float", "0.6")),
       .axes = {facets[0], facets[1], facets[2]},
       .has_inside = true,
       // Measured: 0.0025; the metal has unequal roughnesses.
       .standard_error = 5e-3},
      {.name = "multiply",
       .nodes = element("conductor_bsdf", "BSDF", "x", "{}") +
                element("multiply", "BSDF", "b",
                        from("in1", "BSDF", "x") + value_of("in2", "color3", "0.9, 0.2, 0")),
       .axes = {facets[0], facets[1], facets[2]}},
      {.name = "thin_sheet", .nodes = thin_sheet(), .axes = facets, .albedo_error = 5e-2},
      // OpenPBR 1.1.1, "White furnace testing", with what it must hold regardless of.
      {.name = "open_pbr_furnace",
       .nodes = shader("open_pbr_surface"),
       .axes = {shade("base_color", white), real("base_metalness", shares),
                real("base_diffuse_roughness", shares), real("specular_roughness", roughnesses),
                real("specular_roughness_anisotropy", some_anisotropies),
                real("transmission_weight", shares), real("subsurface_weight", shares),
                shade("subsurface_color", white), real("fuzz_weight", shares),
                real("fuzz_roughness", roughnesses), real("coat_weight", shares),
                real("coat_roughness", roughnesses), real("coat_darkening", {"0"}),
                real("thin_film_weight", shares), real("thin_film_thickness", micrometres),
                real("geometry_opacity", {"1", "0.5"})},
       .is_preserving = true},
  };
}

}  // namespace

std::span<const Composite> composites() {
  static const std::vector<Composite> rows = make_composites();
  return rows;
}

}  // namespace nacre
