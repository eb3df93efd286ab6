#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "tests/pbs/battery/oracle_rows.h"
#include "tests/pbs/independent/fresnel.h"
#include "tests/pbs/independent/microfacet.h"

namespace nacre {

namespace {

using reference::Scattered;
using reference::Vec;
using In = const OracleInputs<Float>&;

constexpr double pi_d = std::numbers::pi;

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

}  // namespace

// Gates of f are what tables and sums cost, as pbs/energy.h and pbs/facet_sum.h say, or as
// bench/results/lobes.md has it where they do not.
std::vector<OracleCase> facet_cases() {
  return {
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
       .standard = {0.15, 1e-4},
       .fast = {0.15, 1e-3},
       .albedo = 0.3},
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
       .standard = {0.12, 0.12},
       .fast = {0.15, 0.15}},
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
       .standard = {9e-2, 1e-4},
       .fast = {9e-2, 1e-3}},
  };
}

}  // namespace nacre
