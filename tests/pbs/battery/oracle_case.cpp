#include "tests/pbs/battery/oracle_case.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/pbs/independent/diffuse.h"
#include "tests/pbs/independent/fresnel.h"
#include "tests/pbs/independent/hair.h"
#include "tests/pbs/independent/integral.h"
#include "tests/pbs/independent/microfacet.h"
#include "tests/pbs/independent/sheen.h"

namespace nacre {

namespace {

using reference::Scattered;
using reference::Vec;

constexpr double pi_d = std::numbers::pi;
using In = const OracleInputs<Float>&;

// Directions.

Vec from_normal(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// At the normal, next to it, and as far as grazing.
Vec draw_view(Random& random, bool inside_too) {
  constexpr double degree = pi_d / 180.0;
  static const std::vector<double> angles{0.0,         1e-4,          20 * degree,   45 * degree,
                                          60 * degree, 80 * degree,   85 * degree,   88 * degree,
                                          89 * degree, 89.9 * degree, 89.99 * degree};
  Vec wo = from_normal(random.pick(angles), 2.0 * pi_d * uniform(random));
  if (inside_too && random.chance(0.5)) wo.z = -wo.z;
  return wo;
}

/// Uniform, and one of four at grazing.
Vec draw_above(Random& random) {
  const double z = random.chance(0.25) ? std::pow(10.0, -4.0 * uniform(random)) : uniform(random);
  return from_normal(std::acos(z), 2.0 * pi_d * uniform(random));
}

// Broad lobes.

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
Ports with(Ports ports, const char* name, Recorded value) {
  ports[name] = std::move(value);
  return ports;
}
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

// Facets.

reference::Facets facets(const Values& in, bool beckmann) {
  return {.beckmann = beckmann, .alpha_x = in.alpha_x, .alpha_y = in.alpha_y};
}

template <class L>
SeenLobe seen_facets(L lobe) {
  return {[lobe](Vec wi) { return lobe.at(wi); }, lobe.albedo()};
}

double index_of(const Values& in, bool inside) { return inside ? 1.0 / in.index : in.index; }

/// The half-way vector has the rounding of both directions by its length: of grazing ones, and of
/// those that hardly bend, that is short. Next to total reflection what passes falls with a root.
double half_way_width(double index, const Values& in, Vec wo, Vec wi) {
  const double ratio = wi.z < 0.0 ? index : 1.0;
  const Vec sum = wo + ratio * wi;
  const double length = std::sqrt(dot(sum, sum));
  const double cosine = std::abs(dot(wo, sum)) / std::max(length, 1e-30);
  const double to_total = std::abs(cosine * cosine + index * index - 1.0) / (cosine + 1e-3);
  return 0.5 * length / std::max(1.0, ratio) * std::min({in.alpha_x, in.alpha_y, to_total});
}
double narrow(const Values& in, Vec wo, Vec wi, bool inside) {
  return half_way_width(index_of(in, inside), in, wo, wi);
}
/// Of metals, which have no such angle.
double narrow_metal(const Values& in, Vec wo, Vec wi, bool) {
  return half_way_width(2.0, in, wo, wi);
}

void draw_alpha(Random& random, Values& in, bool isotropic) {
  static const std::vector<double> alphas{1e-3, 0.01, 0.05, 0.1, 0.3, 0.6, 1.0};
  // Of roughness 1 with anisotropy .5, .95 and 1.
  static const std::vector<double> ratios{0.99, 0.5, 0.05, 0.0};
  in.alpha_x = in.alpha_y = random.pick(alphas);
  if (isotropic) return;
  in.alpha_y = std::max(in.alpha_x * random.pick(ratios), 1e-3);
  if (random.chance(0.5)) std::swap(in.alpha_x, in.alpha_y);
}

void draw_metal(Random& random, OracleView& view) {
  // White, silver and gold in green light, and what lies between metals and glass.
  static const std::vector<std::pair<double, double>> metals{
      {0.0, 1.0}, {0.13, 3.1}, {0.4, 2.4}, {1.5, 1.9}, {0.2, 3.0}};
  const auto [n, k] = random.pick(metals);
  view.inputs.index = n, view.inputs.extinction = k;
  view.wo = draw_view(random, true);
  draw_alpha(random, view.inputs, true);
}
/// Black, and one that reflects all but a narrow ring.
void draw_extreme_metal(Random& random, OracleView& view) {
  draw_metal(random, view);
  const bool black = random.chance(0.5);
  view.inputs.index = black ? 1.0 : 40.0, view.inputs.extinction = black ? 1e-3 : 0.0;
}
void draw_anisotropic_metal(Random& random, OracleView& view) {
  draw_metal(random, view);
  draw_alpha(random, view.inputs, false);
}
void draw_sharp_metal(Random& random, OracleView& view) {
  draw_metal(random, view);
  view.inputs.alpha_x = view.inputs.alpha_y = random.chance(0.5) ? 1e-4 : 3e-4;
}

Ports rough(In in, Ports ports) {
  ports["roughness"] = roughness(in.alpha_x, in.alpha_x);
  return ports;
}
Ports stretched(In in, Ports ports) {
  ports["roughness"] = roughness(in.alpha_x, in.alpha_y);
  return ports;
}
Ports metal(In in) { return {{"ior", colour(in.index)}, {"extinction", colour(in.extinction)}}; }

template <bool beckmann>
SeenLobe seen_metal(const Values& in, Vec wo, bool) {
  const std::complex<double> index{in.index, in.extinction};
  return seen_facets(reference::FacetReflection(
      facets(in, beckmann), wo, [=](double c) { return reference::fresnel(c, index); }));
}

Ports glass(In in, const char* mode) {
  return {{"tint", colour(in.color)}, {"ior", number(in.index)}, {"scatter_mode", text(mode)}};
}
void draw_index(Random& random, OracleView& view, const std::vector<double>& indices) {
  view.inputs.index = random.pick(indices);
  view.inputs.color = random.chance(0.5) ? 1.0 : 0.8;
  view.wo = draw_view(random, true);
  draw_alpha(random, view.inputs, true);
}
void draw_glass(Random& random, OracleView& view) {
  draw_index(random, view, {1.1, 1.33, 1.5, 1.8, 2.5, 1.0 / 1.1, 1.0 / 1.5});
}
void draw_anisotropic_glass(Random& random, OracleView& view) {
  draw_glass(random, view);
  draw_alpha(random, view.inputs, false);
}
/// Nearer 1 than pbs/energy.h speaks of, or farther.
void draw_extreme_glass(Random& random, OracleView& view) {
  draw_index(random, view, {1.002, 1.01, 1.05, 4.5, 40.0, 1.0 / 1.05});
}
/// Reflection alone has no half-way vector that fails.
void draw_extreme_gloss(Random& random, OracleView& view) {
  draw_index(random, view,
             {1.0 + 1e-6, 1.0 - 1e-6, 1.001, 0.999, 1.01, 1.05, 4.5, 40.0, 1.0 / 1.05});
}

SeenLobe tinted(SeenLobe lobe, double tint) {
  const auto at = [lobe, tint](Vec wi) {
    Scattered s = lobe.at(wi);
    s.f *= tint, s.whole_f *= tint;
    return s;
  };
  return {at, tint * lobe.albedo};
}
template <bool beckmann>
SeenLobe seen_gloss(const Values& in, Vec wo, bool inside) {
  const double index = index_of(in, inside);
  const reference::FacetReflection lobe(facets(in, beckmann), wo,
                                        [=](double c) { return reference::fresnel(c, index); });
  return tinted(seen_facets(lobe), in.color);
}
template <bool beckmann>
SeenLobe seen_through(const Values& in, Vec wo, bool inside) {
  const double index = index_of(in, inside);
  return tinted(
      seen_facets(reference::FacetTransmission(facets(in, beckmann), wo, index, index < 1.0)),
      in.color);
}
template <bool beckmann>
SeenLobe seen_glass(const Values& in, Vec wo, bool inside) {
  const double index = index_of(in, inside);
  return tinted(
      seen_facets(reference::FacetInterface(
          facets(in, beckmann), wo, index, [=](double c) { return reference::fresnel(c, index); })),
      in.color);
}

Ports schlick(In in, const char* mode) {
  return {{"color0", colour(in.color)},
          {"color82", colour(in.color82)},
          {"color90", colour(in.color90)},
          {"exponent", number(in.exponent)},
          {"scatter_mode", text(mode)}};
}
void draw_curve(Random& random, OracleView& view) {
  static const std::vector<double> at_0{0.02, 0.04, 0.3}, at_82{1.0, 0.9, 0.5}, at_90{1.0, 0.5},
      exponents{5.0, 3.0, 10.0};
  Values& in = view.inputs;
  in.color = random.pick(at_0), in.color82 = random.pick(at_82), in.color90 = random.pick(at_90);
  in.exponent = random.pick(exponents);
  view.wo = draw_view(random, true);
  draw_alpha(random, in, true);
}
/// Of index 38.
void draw_bright_curve(Random& random, OracleView& view) {
  draw_curve(random, view);
  view.inputs.color = 0.9;
}
reference::Schlick curve_of(const Values& in) {
  return {in.color, in.color82, in.color90, in.exponent};
}
SeenLobe seen_curve(const Values& in, Vec wo, bool) {
  const reference::Schlick curve = curve_of(in);
  return seen_facets(
      reference::FacetReflection(facets(in, false), wo, [=](double c) { return curve.at(c); }));
}
/// From inside the curve is that of the refracted ray.
SeenLobe seen_curved_glass(const Values& in, Vec wo, bool inside) {
  const reference::Schlick curve = curve_of(in);
  const double index = inside ? 1.0 / curve.index() : curve.index();
  return seen_facets(reference::FacetInterface(facets(in, false), wo, index, [=](double c) {
    if (!inside) return curve.at(c);
    if (reference::totally_reflected(c, index)) return 1.0;
    return curve.at(std::sqrt(1.0 - (1.0 - c * c) / (index * index)));
  }));
}

/// By a facet whose slopes are distributed as those of GGX.
template <bool transmits>
Vec toward_facet(Random& random, const Values& in, Vec wo, bool inside) {
  const double index = index_of(in, inside);
  for (int attempt = 0; attempt < 20; ++attempt) {
    const double u = uniform(random), phi = 2.0 * pi_d * uniform(random);
    const double r = std::sqrt(u / (1.0 - u));
    const Vec h =
        reference::unit({in.alpha_x * r * std::cos(phi), in.alpha_y * r * std::sin(phi), 1.0});
    const double c = dot(wo, h);
    if (c <= 0.0) continue;
    if (transmits && random.chance(0.5) && !reference::totally_reflected(c, index)) {
      const double inner = std::sqrt(index * index - (1.0 - c) * (1.0 + c));
      const Vec wi = (1.0 / index) * ((c - inner) * h - wo);
      if (wi.z < 0.0) return wi;
    }
    const Vec wi = 2.0 * c * h - wo;
    if (wi.z > 0.0) return wi;
  }
  return draw_above(random);
}
/// The index is hidden in the curve.
double narrow_curved(const Values& in, Vec wo, Vec wi, bool inside) {
  const double index = curve_of(in).index();
  return half_way_width(inside ? 1.0 / index : index, in, wo, wi);
}
Vec toward_curved_facet(Random& random, const Values& in, Vec wo, bool inside) {
  Values of_glass = in;
  of_glass.index = curve_of(in).index();
  return toward_facet<true>(random, of_glass, wo, inside);
}

// Hair.

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

const std::vector<OracleCase>& oracle_cases() {
  static const std::vector<OracleCase> cases{
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
      {.name = "conductor_bsdf",
       .category = "conductor_bsdf",
       .ports = [](In in) { return rough(in, metal(in)); },
       .seen = seen_metal<false>,
       .draw = draw_metal,
       .toward = toward_facet<false>,
       .width = narrow_metal,
       .standard = {3e-3, 1e-4},
       .fast = {3e-3, 1e-3},
       .albedo = 6e-3},
      {.name = "conductor_bsdf, alpha below 1e-3",
       .category = "conductor_bsdf",
       .ports = [](In in) { return rough(in, metal(in)); },
       .seen = seen_metal<false>,
       .draw = draw_sharp_metal,
       .toward = toward_facet<false>,
       .width = narrow_metal,
       .standard = {3e-3, 1e-4},
       .albedo = 8e-3,
       .is_fast_too = false},
      {.name = "conductor_bsdf, extreme indices",
       .category = "conductor_bsdf",
       .ports = [](In in) { return rough(in, metal(in)); },
       .seen = seen_metal<false>,
       .draw = draw_extreme_metal,
       .toward = toward_facet<false>,
       .width = narrow_metal,
       .standard = {5e-3, 1e-4},
       .fast = {5e-3, 1e-3},
       .albedo = 0.16},
      {.name = "conductor_bsdf, anisotropic",
       .category = "conductor_bsdf",
       .ports = [](In in) { return stretched(in, metal(in)); },
       .seen = seen_metal<false>,
       .draw = draw_anisotropic_metal,
       .toward = toward_facet<false>,
       .width = narrow_metal,
       .standard = {8e-3, 1e-4},
       .fast = {8e-3, 1e-3},
       .albedo = 9e-2},
      {.name = "conductor_bsdf, Beckmann",
       .category = "conductor_bsdf",
       .ports = [](In in) { return with(rough(in, metal(in)), "distribution", text("beckmann")); },
       .seen = seen_metal<true>,
       .draw = draw_metal,
       .toward = toward_facet<false>,
       .width = narrow_metal,
       .standard = {8e-3, 1e-4},
       .fast = {8e-3, 1e-3},
       .albedo = 6e-3},
      {.name = "conductor_bsdf, Beckmann, anisotropic",
       .category = "conductor_bsdf",
       .ports =
           [](In in) { return with(stretched(in, metal(in)), "distribution", text("beckmann")); },
       .seen = seen_metal<true>,
       .draw = draw_anisotropic_metal,
       .toward = toward_facet<false>,
       .width = narrow_metal,
       .standard = {2.5e-2, 1e-4},
       .fast = {2.5e-2, 1e-3},
       .albedo = 1.5e-2},
      {.name = "dielectric_bsdf R",
       .category = "dielectric_bsdf",
       .ports = [](In in) { return rough(in, glass(in, "R")); },
       .seen = seen_gloss<false>,
       .draw = draw_glass,
       .toward = toward_facet<false>,
       .width = narrow,
       .standard = {6e-3, 1e-4},
       .fast = {6e-3, 1e-3},
       .albedo = 3e-2},
      {.name = "dielectric_bsdf R, extreme indices",
       .category = "dielectric_bsdf",
       .ports = [](In in) { return rough(in, glass(in, "R")); },
       .seen = seen_gloss<false>,
       .draw = draw_extreme_gloss,
       .toward = toward_facet<false>,
       .width = narrow,
       .standard = {0.1, 1e-4},
       .fast = {0.1, 1e-3},
       .albedo = 0.56},
      {.name = "dielectric_bsdf R, anisotropic",
       .category = "dielectric_bsdf",
       .ports = [](In in) { return stretched(in, glass(in, "R")); },
       .seen = seen_gloss<false>,
       .draw = draw_anisotropic_glass,
       .toward = toward_facet<false>,
       .width = narrow,
       .standard = {4e-2, 1e-4},
       .fast = {5e-2, 1e-3},
       .albedo = 0.1},
      {.name = "dielectric_bsdf R, Beckmann",
       .category = "dielectric_bsdf",
       .ports =
           [](In in) { return with(rough(in, glass(in, "R")), "distribution", text("beckmann")); },
       .seen = seen_gloss<true>,
       .draw = draw_glass,
       .toward = toward_facet<false>,
       .width = narrow,
       .standard = {6e-3, 1e-4},
       .fast = {6e-3, 1e-3},
       .albedo = 1.5e-2},
      {.name = "dielectric_bsdf T",
       .category = "dielectric_bsdf",
       .ports = [](In in) { return rough(in, glass(in, "T")); },
       .seen = seen_through<false>,
       .draw = draw_glass,
       .toward = toward_facet<true>,
       .width = narrow,
       .standard = {3e-2, 5e-2},
       .fast = {3e-2, 5e-2}},
      {.name = "dielectric_bsdf T, extreme indices",
       .category = "dielectric_bsdf",
       .ports = [](In in) { return rough(in, glass(in, "T")); },
       .seen = seen_through<false>,
       .draw = draw_extreme_glass,
       .toward = toward_facet<true>,
       .width = narrow,
       .standard = {5.0, 1.1},
       .fast = {5.0, 1.1}},
      {.name = "dielectric_bsdf T, anisotropic",
       .category = "dielectric_bsdf",
       .ports = [](In in) { return stretched(in, glass(in, "T")); },
       .seen = seen_through<false>,
       .draw = draw_anisotropic_glass,
       .toward = toward_facet<true>,
       .width = narrow,
       .standard = {3e-2, 3e-2},
       .fast = {0.12, 0.12}},
      {.name = "dielectric_bsdf RT",
       .category = "dielectric_bsdf",
       .ports = [](In in) { return rough(in, glass(in, "RT")); },
       .seen = seen_glass<false>,
       .draw = draw_glass,
       .toward = toward_facet<true>,
       .width = narrow,
       .standard = {8e-2, 1e-4},
       .fast = {8e-2, 1e-3}},
      {.name = "dielectric_bsdf RT, extreme indices",
       .category = "dielectric_bsdf",
       .ports = [](In in) { return rough(in, glass(in, "RT")); },
       .seen = seen_glass<false>,
       .draw = draw_extreme_glass,
       .toward = toward_facet<true>,
       .width = narrow,
       .standard = {0.6, 1e-4},
       .fast = {0.6, 1e-3}},
      {.name = "dielectric_bsdf RT, anisotropic",
       .category = "dielectric_bsdf",
       .ports = [](In in) { return stretched(in, glass(in, "RT")); },
       .seen = seen_glass<false>,
       .draw = draw_anisotropic_glass,
       .toward = toward_facet<true>,
       .width = narrow,
       .standard = {8e-2, 1e-4},
       .fast = {8e-2, 1e-3}},
      {.name = "dielectric_bsdf RT, Beckmann",
       .category = "dielectric_bsdf",
       .ports =
           [](In in) { return with(rough(in, glass(in, "RT")), "distribution", text("beckmann")); },
       .seen = seen_glass<true>,
       .draw = draw_glass,
       .toward = toward_facet<true>,
       .width = narrow,
       .standard = {6e-2, 1e-4},
       .fast = {6e-2, 1e-3}},
      {.name = "generalized_schlick_bsdf R",
       .category = "generalized_schlick_bsdf",
       .ports = [](In in) { return rough(in, schlick(in, "R")); },
       .seen = seen_curve,
       .draw = draw_curve,
       .toward = toward_curved_facet,
       .width = narrow_metal,
       .standard = {1.5e-2, 1e-4},
       .fast = {1.5e-2, 1e-3},
       .albedo = 6e-2},
      {.name = "generalized_schlick_bsdf RT",
       .category = "generalized_schlick_bsdf",
       .ports = [](In in) { return rough(in, schlick(in, "RT")); },
       .seen = seen_curved_glass,
       .draw = draw_curve,
       .toward = toward_curved_facet,
       .width = narrow_curved,
       .standard = {9e-2, 1e-4},
       .fast = {9e-2, 1e-3}},
      {.name = "generalized_schlick_bsdf RT, color0 0.9",
       .category = "generalized_schlick_bsdf",
       .ports = [](In in) { return rough(in, schlick(in, "RT")); },
       .seen = seen_curved_glass,
       .draw = draw_bright_curve,
       .toward = toward_curved_facet,
       .width = narrow_curved,
       .standard = {0.5, 1e-4},
       .fast = {0.5, 1e-3}},
      {.name = "chiang_hair_bsdf",
       .category = "chiang_hair_bsdf",
       .ports = hair,
       .seen = seen_hair,
       .draw = draw_hair,
       .toward = toward_way,
       .width = hair_width,
       .standard = {5e-4, 5e-4},
       .fast = {0.4, 0.4}},
  };
  return cases;
}

}  // namespace nacre
