#include "tests/pbs/battery/closure_case.h"

#include <algorithm>
#include <array>

namespace nacre {

namespace {

using Forms = std::vector<std::vector<Setting>>;

/// Of the library of 2018, whose successor has GGX alone.
Forms distributions() { return {{{"distribution", "ggx"}}, {{"distribution", "beckmann"}}}; }

Forms interfaces() {
  return {{{"scatter_mode", "R"}, {"retroreflective", "false"}},
          {{"scatter_mode", "R"}, {"retroreflective", "true"}},
          {{"scatter_mode", "T"}},
          {{"scatter_mode", "RT"}}};
}

Forms truths(std::string_view input) { return {{{input, "false"}}, {{input, "true"}}}; }

std::vector<ClosureCase> make_cases() {
  const std::vector<std::vector<Setting>> sheens{{{"mode", "conty_kulla"}}, {{"mode", "zeltner"}}};
  return {
      // Lobes of the data library.
      {.nodedef = "ND_burley_diffuse_bsdf"},
      {.nodedef = "ND_chiang_hair_bsdf"},
      {.nodedef = "ND_conductor_bsdf", .forms = truths("retroreflective")},
      {.nodedef = "ND_dielectric_bsdf", .forms = interfaces()},
      {.nodedef = "ND_generalized_schlick_bsdf", .forms = interfaces()},
      {.nodedef = "ND_oren_nayar_diffuse_bsdf", .forms = truths("energy_compensation")},
      {.nodedef = "ND_sheen_bsdf", .forms = sheens},
      {.nodedef = "ND_subsurface_bsdf"},
      {.nodedef = "ND_translucent_bsdf"},
      // What is made of lobes.
      {.nodedef = "ND_add_bsdf", .large = true},
      {.nodedef = "ND_layer_bsdf", .large = true},
      {.nodedef = "ND_layer_vdf", .large = true},
      {.nodedef = "ND_mix_bsdf", .large = true},
      {.nodedef = "ND_multiply_bsdfC", .large = true},
      {.nodedef = "ND_multiply_bsdfF", .large = true},
      // Emission.
      {.nodedef = "ND_add_edf"},
      {.nodedef = "ND_conical_edf"},
      {.nodedef = "ND_generalized_schlick_edf"},
      {.nodedef = "ND_measured_edf"},
      {.nodedef = "ND_mix_edf"},
      {.nodedef = "ND_multiply_edfC"},
      {.nodedef = "ND_multiply_edfF"},
      {.nodedef = "ND_uniform_edf"},
      // Media.
      {.nodedef = "ND_absorption_vdf"},
      {.nodedef = "ND_add_vdf"},
      {.nodedef = "ND_anisotropic_vdf"},
      {.nodedef = "ND_mix_vdf"},
      {.nodedef = "ND_multiply_vdfC"},
      {.nodedef = "ND_multiply_vdfF"},
      // Shaders of the data library.
      {.nodedef = "ND_convert_boolean_surfaceshader"},
      {.nodedef = "ND_convert_color3_surfaceshader"},
      {.nodedef = "ND_convert_color4_surfaceshader"},
      {.nodedef = "ND_convert_float_surfaceshader"},
      {.nodedef = "ND_convert_integer_surfaceshader"},
      {.nodedef = "ND_convert_vector2_surfaceshader"},
      {.nodedef = "ND_convert_vector3_surfaceshader"},
      {.nodedef = "ND_convert_vector4_surfaceshader"},
      {.nodedef = "ND_displacement_float"},
      {.nodedef = "ND_displacement_vector3"},
      {.nodedef = "ND_dot_displacementshader"},
      {.nodedef = "ND_dot_lightshader"},
      {.nodedef = "ND_dot_surfaceshader", .large = true},
      {.nodedef = "ND_dot_volumeshader"},
      {.nodedef = "ND_mix_displacementshader"},
      {.nodedef = "ND_mix_surfaceshader", .large = true},
      {.nodedef = "ND_mix_volumeshader"},
      {.nodedef = "ND_surface", .forms = truths("thin_walled"), .large = true},
      {.nodedef = "ND_surface_unlit"},
      {.nodedef = "ND_volume"},
      // Lights.
      {.nodedef = "ND_directional_light"},
      {.nodedef = "ND_light"},
      {.nodedef = "ND_point_light"},
      {.nodedef = "ND_spot_light"},
      // Materials.
      {.nodedef = "ND_UsdPreviewSurface_surfaceshader", .large = true},
      {.nodedef = "ND_disney_principled", .large = true},
      {.nodedef = "ND_gltf_pbr_surfaceshader", .large = true},
      {.nodedef = "ND_open_pbr_surface_surfaceshader",
       .forms = truths("geometry_thin_walled"),
       .large = true},
      {.nodedef = "ND_standard_surface_surfaceshader", .large = true},
      {.nodedef = "ND_standard_surface_surfaceshader_100", .large = true},
      // Lama.
      {.nodedef = "ND_lama_add_bsdf", .large = true},
      {.nodedef = "ND_lama_add_edf"},
      {.nodedef = "ND_lama_conductor", .large = true},
      {.nodedef = "ND_lama_dielectric", .large = true},
      {.nodedef = "ND_lama_diffuse"},
      {.nodedef = "ND_lama_emission"},
      {.nodedef = "ND_lama_generalized_schlick", .large = true},
      {.nodedef = "ND_lama_iridescence"},
      {.nodedef = "ND_lama_layer_bsdf", .large = true},
      {.nodedef = "ND_lama_mix_bsdf", .large = true},
      {.nodedef = "ND_lama_mix_edf"},
      {.nodedef = "ND_lama_sheen"},
      {.nodedef = "ND_lama_sss"},
      {.nodedef = "ND_lama_translucent"},
      // alShaders, of pbs/library.
      {.nodedef = "ND_alHair", .large = true},
      {.nodedef = "ND_alLayer", .large = true},
      {.nodedef = "ND_alSurface", .large = true},
      {.nodedef = "ND_alSurface_specular", .large = true},
      // The library of 2018, of pbs/library.
      {.nodedef = "ND_absorptionvdf"},
      {.nodedef = "ND_anisotropicvdf"},
      {.nodedef = "ND_conductorbrdf", .forms = distributions()},
      {.nodedef = "ND_conicaledf"},
      {.nodedef = "ND_dielectricbrdf", .forms = distributions(), .large = true},
      {.nodedef = "ND_dielectricbtdf", .forms = distributions(), .large = true},
      {.nodedef = "ND_diffusebrdf"},
      {.nodedef = "ND_diffusebtdf"},
      {.nodedef = "ND_light_color3"},
      {.nodedef = "ND_measurededf"},
      {.nodedef = "ND_mixbsdf", .large = true},
      {.nodedef = "ND_mixedf"},
      {.nodedef = "ND_mixsurface", .large = true},
      {.nodedef = "ND_mixvdf"},
      {.nodedef = "ND_scalebsdf", .large = true},
      {.nodedef = "ND_scaledvdf"},
      {.nodedef = "ND_scalededf"},
      {.nodedef = "ND_sheenbrdf"},
      {.nodedef = "ND_subsurfacebrdf"},
      {.nodedef = "ND_thinfilmbsdf"},
      {.nodedef = "ND_uniformedf"},
  };
}

/// A word of a name and what such inputs are; the first that is in it counts.
struct Word {
  std::string_view text;
  Meaning meaning;
};

constexpr std::array words = std::to_array<Word>({
    {"normal", Meaning::direction},
    {"tangent", Meaning::direction},
    {"direction", Meaning::direction},
    {"position", Meaning::position},
    {"roughness", Meaning::alpha},
    {"width", Meaning::alpha},
    {"affect", Meaning::share},
    {"rotation", Meaning::degrees},
    {"angle", Meaning::degrees},
    {"shift", Meaning::degrees},
    {"anisotrop", Meaning::anisotropy},
    {"filmior", Meaning::index},
    {"film", Meaning::film},
    {"thickness", Meaning::film},
    {"ior", Meaning::index},
    {"extinction", Meaning::extinction},
    {"abbe", Meaning::index},
    {"dispersion", Meaning::share},
    {"attenuationcolor", Meaning::color},
    {"radius", Meaning::length},
    {"depth", Meaning::length},
    {"distance", Meaning::length},
    {"unitlength", Meaning::length},
    {"scale", Meaning::length},
    {"absorptioncolor", Meaning::color},
    {"scattercolor", Meaning::color},
    {"absorption", Meaning::coefficient},
    {"scattering", Meaning::coefficient},
    {"scatter", Meaning::coefficient},
    {"exponent", Meaning::exponent},
    {"profile", Meaning::exponent},
    {"decay", Meaning::exponent},
    {"exposure", Meaning::exponent},
    {"emissi", Meaning::radiance},
    {"luminance", Meaning::radiance},
    {"intensity", Meaning::radiance},
    {"displacement", Meaning::position},
});

}  // namespace

std::span<const ClosureCase> closure_cases() {
  static const std::vector<ClosureCase> cases = make_cases();
  return cases;
}

Meaning meaning_of(const ClosureCase& row, std::string_view input, bool is_color) {
  for (const auto& [name, meaning] : row.meanings) {
    if (name == input) return meaning;
  }
  // Of an input of a closure within: "in1/roughness".
  std::string name;
  for (const char c : input.substr(input.rfind('/') + 1)) {
    if (c != '_') name += static_cast<char>('A' <= c && c <= 'Z' ? c - 'A' + 'a' : c);
  }
  const auto found = std::ranges::find_if(
      words, [&](const Word& word) { return name.find(word.text) != std::string::npos; });
  if (found != words.end()) return found->meaning;
  return is_color ? Meaning::color : Meaning::share;
}

std::string short_name(const ClosureCase& row) { return std::string(row.nodedef.substr(3)); }

}  // namespace nacre
