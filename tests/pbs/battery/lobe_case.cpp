#include "tests/pbs/battery/lobe_case.h"

#include <utility>

namespace nacre {

namespace {

Recorded flag(bool x) { return {Type::boolean, Bool(x)}; }
Recorded color(Color3 x) { return {Type::color3, x}; }
Recorded beckmann() { return text("beckmann"); }

Ports diffuse(const LobeInputs& in) {
  return {{"color", color(in.color)}, {"roughness", number(in.roughness)}};
}
Ports with(Ports ports, const char* name, Recorded value) {
  ports[name] = std::move(value);
  return ports;
}
/// A metal of index 0 reflects all light; its colour is not an input.
Ports metal(const LobeInputs& in, float n, float k, float stretch) {
  const Float alpha = square(in.roughness);
  return {{"ior", colour(n)},
          {"extinction", colour(k)},
          {"roughness", roughness(alpha, min(stretch * alpha, 1.0f))}};
}

Ports glass(const LobeInputs& in, const char* mode) {
  const Float alpha = square(in.roughness);
  return {{"tint", color(in.color)},
          {"ior", number(in.index)},
          {"roughness", roughness(alpha, alpha)},
          {"scatter_mode", text(mode)}};
}
/// From a tenth of the colour at normal incidence to all of it at grazing.
Ports schlick(const LobeInputs& in, const char* mode) {
  const Float alpha = square(in.roughness);
  return {{"color0", color(in.color * Color3(0.1f))},
          {"color82", color(in.color)},
          {"color90", color(in.color)},
          {"roughness", roughness(alpha, alpha)},
          {"scatter_mode", text(mode)}};
}

/// Roughnesses by the fits of Chiang et al. 2016, as chiang_hair_roughness gives them.
Ports hair(const LobeInputs& in, float cuticle_angle, float absorption) {
  const Float r = in.roughness;
  const Float r4 = square(square(r));
  const Float r20 = r4 * square(square(r4));
  const Float v = square(fma(3.7f, r20, r * fma(0.812f, r, 0.726f)));
  const Float s = fma(5.372f, r20 * square(r), r * fma(1.194f, r, 0.265f));
  return {{"tint_R", color(in.color)},
          {"tint_TT", color(in.color)},
          {"tint_TRT", color(in.color)},
          {"ior", number(in.index)},
          {"roughness_R", roughness(v, s)},
          {"roughness_TT", roughness(0.25f * v, s)},
          {"roughness_TRT", roughness(4.0f * v, s)},
          {"cuticle_angle", number(cuticle_angle)},
          {"absorption_coefficient", colour(absorption)}};
}

/// Of lobes that a smooth fibre makes narrow along and around it: what angles lack in digits, the
/// exponent multiplies; and the random number that chooses a way is used again within it.
constexpr RoundingBounds narrow_standard{1e-4, 1e-4, 5e-5};
constexpr RoundingBounds narrow_fast{2e-2, 2e-2, 5e-3};

}  // namespace

const std::vector<LobeCase>& lobe_cases() {
  using In = const LobeInputs&;
  static const std::vector<LobeCase> cases{
      {.name = "oren_nayar",
       .category = "oren_nayar_diffuse_bsdf",
       .ports = [](In in) { return with(diffuse(in), "energy_compensation", flag(false)); },
       .energy = Energy::exceeding,
       .most_light = 1.0065},
      {.name = "oren_nayar_compensated",
       .category = "oren_nayar_diffuse_bsdf",
       .ports = [](In in) { return with(diffuse(in), "energy_compensation", flag(true)); },
       .energy = Energy::preserving,
       .preserving_error = 2e-3},
      {.name = "burley",
       .category = "burley_diffuse_bsdf",
       .ports = diffuse,
       .energy = Energy::exceeding,
       .most_light = 1.4006},
      {.name = "translucent",
       .category = "translucent_bsdf",
       .ports = diffuse,
       .rough = false,
       .energy = Energy::preserving,
       .preserving_error = 2e-3},
      {.name = "subsurface",
       .category = "subsurface_bsdf",
       .ports = diffuse,
       .rough = false,
       .energy = Energy::preserving,
       .preserving_error = 2e-3},
      {.name = "sheen_conty_kulla",
       .category = "sheen_bsdf",
       .ports = [](In in) { return with(diffuse(in), "mode", text("conty_kulla")); },
       .reciprocity = 1.58},
      {.name = "sheen_zeltner",
       .category = "sheen_bsdf",
       .ports = [](In in) { return with(diffuse(in), "mode", text("zeltner")); },
       .reciprocity = 0.0},
      {.name = "white_metal",
       .category = "conductor_bsdf",
       .ports = [](In in) { return metal(in, 0.0f, 1.0f, 1.0f); },
       .energy = Energy::preserving,
       .albedo_error = 1e-2,
       .reciprocity = 3.25},
      {.name = "metal",
       .category = "conductor_bsdf",
       .ports = [](In in) { return metal(in, 0.2f, 3.0f, 1.0f); },
       .albedo_error = 1e-2,
       .reciprocity = 3.08},
      {.name = "anisotropic_metal",
       .category = "conductor_bsdf",
       .ports = [](In in) { return metal(in, 0.2f, 3.0f, 4.0f); },
       .albedo_error = 1.5e-2,
       .reciprocity = 3.08},
      {.name = "dielectric_reflection",
       .category = "dielectric_bsdf",
       .ports = [](In in) { return glass(in, "R"); },
       .albedo_error = 1e-2,
       .reciprocity = 0.0},
      {.name = "dielectric_transmission",
       .category = "dielectric_bsdf",
       .ports = [](In in) { return glass(in, "T"); },
       .energy = Energy::preserving,
       .albedo_error = 1e-2,
       .reciprocity = 0.0},
      {.name = "dielectric_interface",
       .category = "dielectric_bsdf",
       .ports = [](In in) { return glass(in, "RT"); },
       .energy = Energy::preserving,
       .albedo_error = 1e-2,
       .reciprocity = 0.0},
      {.name = "schlick_reflection",
       .category = "generalized_schlick_bsdf",
       .ports = [](In in) { return schlick(in, "R"); },
       .albedo_error = 1e-2,
       .reciprocity = 0.0},
      {.name = "schlick_interface",
       .category = "generalized_schlick_bsdf",
       .ports = [](In in) { return schlick(in, "RT"); },
       .energy = Energy::preserving,
       .albedo_error = 1e-2,
       .reciprocity = 0.0,
       .slow_in_double = true},
      {.name = "beckmann_metal",
       .category = "conductor_bsdf",
       .ports = [](In in) { return with(metal(in, 0.2f, 3.0f, 1.0f), "distribution", beckmann()); },
       .albedo_error = 1e-2,
       .reciprocity = 0.0},
      {.name = "beckmann_transmission",
       .category = "dielectric_bsdf",
       .ports = [](In in) { return with(glass(in, "T"), "distribution", beckmann()); },
       .energy = Energy::preserving,
       .albedo_error = 1e-2,
       .reciprocity = 0.0},
      {.name = "beckmann_interface",
       .category = "dielectric_bsdf",
       .ports = [](In in) { return with(glass(in, "RT"), "distribution", beckmann()); },
       .energy = Energy::preserving,
       .albedo_error = 1e-2,
       .reciprocity = 0.0},
      {.name = "hair",
       .category = "chiang_hair_bsdf",
       .ports = [](In in) { return hair(in, 0.5f, 0.0f); },
       .energy = Energy::preserving,
       .preserving_error = 2e-3,
       .reciprocity = 0.0,
       .least_roughness = 0.1f,
       .standard = narrow_standard,
       .fast = narrow_fast},
      {.name = "tilted_hair",
       .category = "chiang_hair_bsdf",
       .ports = [](In in) { return hair(in, 0.52f, 0.3f); },
       .reciprocity = 0.0,
       .least_roughness = 0.1f,
       .standard = narrow_standard,
       .fast = narrow_fast},
  };
  return cases;
}

BsdfPtr make_lobe(Recorder& recorder, const LobeCase& row, const LobeInputs& inputs,
                  Accuracy accuracy, Ports more) {
  Ports ports = row.ports(inputs);
  for (auto& [name, value] : more) ports[name] = value;
  return microfacet_bsdf(recorder, row.category, std::move(ports), accuracy);
}

}  // namespace nacre
