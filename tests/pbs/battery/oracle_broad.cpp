#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/pbs/battery/oracle_rows.h"
#include "tests/pbs/independent/diffuse.h"
#include "tests/pbs/independent/hair.h"
#include "tests/pbs/independent/integral.h"
#include "tests/pbs/independent/sheen.h"

namespace nacre {

namespace {

using reference::Scattered;
using reference::Vec;
using In = const OracleInputs<Float>&;

constexpr double pi_d = std::numbers::pi;

void draw_diffuse(Random& random, OracleView& view) {
  static const std::vector<double> roughness{0.0, 0.01, 0.1, 0.3, 0.6, 1.0};
  static const std::vector<double> colors{1e-3, 0.18, 0.8, 1.0};
  view.inputs.roughness = random.pick(roughness);
  view.inputs.color = random.pick(colors);
  view.wo = draw_view(random, false);
}
Vec toward_any(Random& random, const Values&, Vec, bool) { return draw_above(random); }
Vec toward_other(Random& random, const Values&, Vec, bool) { return -1.0 * draw_above(random); }
double broad(const Values&, Vec, Vec, bool) { return 1.0; }

template <class F>
SeenLobe integrated(F at) {
  return {at, std::min(reference::integral(at), 1.0)};
}

Ports diffuse(In in) { return {{"color", colour(in.color)}, {"roughness", number(in.roughness)}}; }
Recorded flag(bool x) { return {Type::boolean, Bool(x)}; }

template <class Sheen>
SeenLobe seen_sheen(double lowest, const Values& in, Vec wo) {
  const Sheen sheen(std::max(in.roughness, lowest), wo);
  const double color = in.color;
  const auto at = [sheen, color](Vec wi) {
    const Scattered s = sheen.at(wi);
    return Scattered{color * s.f, s.pdf};
  };
  return {at, color * sheen.albedo()};
}

reference::Fibre fibre(const Values& in) {
  return {.index = in.index,
          .variance = {in.variance, 0.25 * in.variance, 4.0 * in.variance},
          .scale = {in.scale, in.scale, in.scale},
          .tilt = (in.cuticle_angle - 0.5) * pi_d,
          .absorption = in.absorption};
}
Ports hair(In in) {
  return {{"tint_R", colour(1.0f)},
          {"tint_TT", colour(1.0f)},
          {"tint_TRT", colour(1.0f)},
          {"ior", number(in.index)},
          {"roughness_R", roughness(in.variance, in.scale)},
          {"roughness_TT", roughness(0.25f * in.variance, in.scale)},
          {"roughness_TRT", roughness(4.0f * in.variance, in.scale)},
          {"cuticle_angle", number(in.cuticle_angle)},
          {"absorption_coefficient", colour(in.absorption)}};
}
/// What chiang_hair_roughness makes of roughnesses from 1e-3 to 1.
void draw_hair(Random& random, OracleView& view) {
  static const std::vector<double> betas{1e-3, 0.01, 0.1, 0.3, 1.0};
  static const std::vector<double> elevations{0.0, 0.1, 0.8, 1.4, 1.55};
  Values& in = view.inputs;
  const auto power = [](double x, double y) { return std::pow(x, y); };
  const double m = random.pick(betas), n = random.pick(betas);
  in.variance = std::max(power(0.726 * m + 0.812 * m * m + 3.7 * power(m, 20.0), 2.0), 2e-6);
  in.scale = std::max(0.265 * n + 1.194 * n * n + 5.372 * power(n, 22.0), 1e-3);
  in.index = random.chance(0.5) ? 1.55 : 1.2;
  in.cuticle_angle = random.chance(0.5) ? 0.5 : 0.52;
  in.absorption = random.chance(0.5) ? 0.0 : 0.8;
  const double elevation = random.pick(elevations) * (random.chance(0.5) ? 1.0 : -1.0);
  const double azimuth = pi_d * (0.02 + 0.96 * uniform(random));
  view.wo = {std::sin(elevation), std::cos(elevation) * std::cos(azimuth),
             std::cos(elevation) * std::sin(azimuth)};
}
SeenLobe seen_hair(const Values& in, Vec wo, bool) {
  const reference::Hair lobe(fibre(in), wo);
  return {[lobe](Vec wi) { return lobe.at(wi); }, lobe.albedo()};
}
Vec toward_way(Random& random, const Values& in, Vec wo, bool) {
  const reference::Fibre of = fibre(in);
  const reference::Hair lobe(of, wo);
  const std::size_t p = random.below(3);
  const reference::Way& way = lobe.ways()[p];
  const auto off = [&] { return 6.0 * uniform(random) - 3.0; };
  const double elevation =
      std::clamp(-way.elevation + std::sqrt(of.variance[p]) * off(), -1.55, 1.55);
  const double azimuth = way.azimuth + of.scale[p] * off();
  return {std::sin(elevation), std::cos(elevation) * std::cos(azimuth),
          std::cos(elevation) * std::sin(azimuth)};
}
/// Along it, and around it as far as digits tell the azimuths.
double hair_width(const Values& in, Vec wo, Vec wi, bool) {
  const double across = std::min(std::hypot(wo.y, wo.z), std::hypot(wi.y, wi.z));
  return std::min({0.5 * std::sqrt(in.variance), in.scale * across, 1.0});
}

}  // namespace

// Of conty_kulla the gate is what pbs/lobes/sheen_bsdf.cpp says of its fit. In the tails
// of the narrowest fibres the errors of `fast` count twelve times.
std::vector<OracleCase> broad_cases() {
  return {
      {.name = "oren_nayar_diffuse_bsdf",
       .category = "oren_nayar_diffuse_bsdf",
       .ports = [](In in) { return with(diffuse(in), "energy_compensation", flag(false)); },
       .seen =
           [](const Values& in, Vec wo, bool) {
             return integrated(
                 [=](Vec wi) { return reference::oren_nayar(in.color, in.roughness, wo, wi); });
           },
       .draw = draw_diffuse,
       .toward = toward_any,
       .width = broad},
      {.name = "oren_nayar_diffuse_bsdf, compensated",
       .category = "oren_nayar_diffuse_bsdf",
       .ports = [](In in) { return with(diffuse(in), "energy_compensation", flag(true)); },
       .seen =
           [](const Values& in, Vec wo, bool) {
             return integrated([=](Vec wi) {
               return reference::energy_preserving_oren_nayar(in.color, in.roughness, wo, wi);
             });
           },
       .draw = draw_diffuse,
       .toward = toward_any,
       .width = broad},
      {.name = "burley_diffuse_bsdf",
       .category = "burley_diffuse_bsdf",
       .ports = diffuse,
       .seen =
           [](const Values& in, Vec wo, bool) {
             return integrated(
                 [=](Vec wi) { return reference::burley(in.color, in.roughness, wo, wi); });
           },
       .draw = draw_diffuse,
       .toward = toward_any,
       .width = broad},
      {.name = "translucent_bsdf",
       .category = "translucent_bsdf",
       .ports = diffuse,
       .seen = [](const Values& in, Vec, bool) -> SeenLobe {
         return {[=](Vec wi) { return reference::lambert(in.color, -1.0 * wi); }, in.color};
       },
       .draw = draw_diffuse,
       .toward = toward_other,
       .width = broad},
      {.name = "subsurface_bsdf, diffuse limit",
       .category = "subsurface_bsdf",
       .ports = diffuse,
       .seen = [](const Values& in, Vec, bool) -> SeenLobe {
         return {[=](Vec wi) { return reference::lambert(in.color, wi); }, in.color};
       },
       .draw = draw_diffuse,
       .toward = toward_any,
       .width = broad},
      {.name = "sheen_bsdf, conty_kulla",
       .category = "sheen_bsdf",
       .ports = [](In in) { return with(diffuse(in), "mode", text("conty_kulla")); },
       .seen = [](const Values& in, Vec wo,
                  bool) { return seen_sheen<reference::FibreSheen>(0.07, in, wo); },
       .draw = draw_diffuse,
       .toward = toward_any,
       .width = broad,
       .standard = {6e-4, 1e-4},
       .albedo = 6e-4},
      {.name = "sheen_bsdf, zeltner",
       .category = "sheen_bsdf",
       .ports = [](In in) { return with(diffuse(in), "mode", text("zeltner")); },
       .seen = [](const Values& in, Vec wo,
                  bool) { return seen_sheen<reference::TransformedSheen>(0.01, in, wo); },
       .draw = draw_diffuse,
       .toward = toward_any,
       .width = [](const Values& in, Vec, Vec, bool) { return std::max(in.roughness, 0.01); }},
      {.name = "chiang_hair_bsdf",
       .category = "chiang_hair_bsdf",
       .ports = hair,
       .seen = seen_hair,
       .draw = draw_hair,
       .toward = toward_way,
       .width = hair_width,
       .standard = {1e-4, 1e-4},
       .fast = {2e-2, 2e-2}},
  };
}

}  // namespace nacre
