#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <tuple>

#include "tests/pbs/battery/oracle_rows.h"
#include "tests/pbs/independent/fresnel.h"
#include "tests/pbs/independent/microfacet.h"
#include "tests/pbs/independent/thin_film.h"

namespace nacre {

namespace {

using reference::Scattered;
using reference::Vec;
using In = const OracleInputs<Float>&;

/// Airy's sum at all wavelengths, as lobes have it: cut to [0, 1]. Known at so many cosines, next
/// to grazing the most, and straight between.
class FilmCurve {
 public:
  FilmCurve(double thickness, double index, std::complex<double> substrate) {
    for (std::size_t i = 0; i < nodes; ++i) {
      const double c = std::max(std::pow(static_cast<double>(i) / (nodes - 1), 2), 1e-12);
      double sum = 0.0;
      const auto rgb =
          reference::thin_film_rgb(c, thickness, index, substrate, reference::gaussian_sensitivity);
      for (const double x : rgb) sum += std::clamp(x, 0.0, 1.0);
      red_[i] = std::clamp(rgb[0], 0.0, 1.0), mean_[i] = sum / 3.0;
    }
  }
  double red(double cosine) const { return at(red_, cosine); }
  /// Of the channels: what reflects and what passes are chosen by it.
  double mean(double cosine) const { return at(mean_, cosine); }

 private:
  static constexpr std::size_t nodes = 768;
  using Curve = std::array<double, nodes>;

  static double at(const Curve& values, double cosine) {
    const double place = std::sqrt(std::clamp(cosine, 0.0, 1.0)) * (nodes - 1);
    const auto i = std::min(static_cast<std::size_t>(place), nodes - 2);
    // Between two squares.
    const double low = std::pow(static_cast<double>(i) / (nodes - 1), 2);
    const double high = std::pow(static_cast<double>(i + 1) / (nodes - 1), 2);
    const double t = (cosine - low) / (high - low);
    return values[i] + std::clamp(t, 0.0, 1.0) * (values[i + 1] - values[i]);
  }

  Curve red_{}, mean_{};
};

constexpr std::array thicknesses{150.0, 400.0, 700.0};
constexpr std::array film_indices{1.25, 2.0};
constexpr std::array glasses{1.5, 1.8};
constexpr std::array<std::pair<double, double>, 2> metals{{{0.2, 3.0}, {1.5, 1.9}}};

using FilmKey = std::tuple<float, float, float, float>;
FilmKey key_of(const Values& in) {
  const auto number = [](double x) { return static_cast<float>(x); };
  return {number(in.film_thickness), number(in.film_index), number(in.index),
          number(in.extinction)};
}

/// Of all that rows draw.
const FilmCurve& film_of(const Values& in) {
  static const std::map<FilmKey, FilmCurve> curves = [] {
    std::map<FilmKey, FilmCurve> all;
    Values values;
    const auto add = [&] {
      for (const double thickness : thicknesses) {
        for (const double film : film_indices) {
          values.film_thickness = thickness, values.film_index = film;
          const auto as_float = [](double x) { return double{static_cast<float>(x)}; };
          all.emplace(key_of(values),
                      FilmCurve(thickness, as_float(film),
                                {as_float(values.index), as_float(values.extinction)}));
        }
      }
    };
    for (const auto& [n, k] : metals) values.index = n, values.extinction = k, add();
    values.extinction = 0.0;
    for (const double n : glasses) values.index = n, add();
    return all;
  }();
  return curves.at(key_of(in));
}

reference::Facets facets(const Values& in) {
  return {.alpha_x = in.alpha_x, .alpha_y = in.alpha_y};
}

void draw_surface(Random& random, OracleView& view, bool inside_too) {
  static const std::vector<double> alphas{0.01, 0.05, 0.1, 0.3, 0.6, 1.0};
  view.inputs.alpha_x = view.inputs.alpha_y = random.pick(alphas);
  view.wo = draw_view(random, inside_too);
}
void draw_film(Random& random, OracleView& view) {
  view.inputs.film_thickness = thicknesses[random.word() % thicknesses.size()];
  view.inputs.film_index = film_indices[random.word() % film_indices.size()];
}
void draw_filmed_metal(Random& random, OracleView& view) {
  const auto& [n, k] = metals[random.word() % metals.size()];
  view.inputs.index = n, view.inputs.extinction = k;
  draw_film(random, view);
  draw_surface(random, view, true);
}
/// From outside: thin_film() has vacuum before it.
void draw_filmed_glass(Random& random, OracleView& view) {
  view.inputs.index = glasses[random.word() % glasses.size()];
  view.inputs.color = 1.0;
  draw_film(random, view);
  draw_surface(random, view, false);
}
void draw_wall(Random& random, OracleView& view) {
  static const std::vector<double> indices{1.1, 1.33, 1.5, 1.8, 2.5};
  view.inputs.index = random.pick(indices);
  view.inputs.color = random.chance(0.5) ? 1.0 : 0.8;
  draw_surface(random, view, true);
  view.inputs.alpha_x = view.inputs.alpha_y = std::max(view.inputs.alpha_x, 0.05);
}

/// Interference may take all light, which leaves nothing for errors to be relative to: they are of
/// no less than what this reflects.
double seen_at_least(double) { return 0.05; }

SeenLobe seen_filmed(const Values& in, Vec wo, bool) {
  const FilmCurve* const film = &film_of(in);
  const reference::FacetReflection lobe(facets(in), wo, [film](double c) { return film->red(c); });
  const reference::FacetReflection least(facets(in), wo, seen_at_least);
  const auto at = [=](Vec wi) {
    Scattered s = lobe.at(wi);
    s.whole_f = least.at(wi).f;
    return s;
  };
  return {at, lobe.albedo()};
}
SeenLobe seen_filmed_glass(const Values& in, Vec wo, bool) {
  const FilmCurve* const film = &film_of(in);
  const reference::FacetInterface lobe(facets(in), wo, in.index,
                                       [film](double c) { return film->red(c); });
  const reference::FacetInterface chosen(facets(in), wo, in.index,
                                         [film](double c) { return film->mean(c); });
  const reference::FacetInterface least(facets(in), wo, in.index, seen_at_least);
  const auto at = [=](Vec wi) {
    Scattered s = lobe.at(wi);
    const Scattered dark = least.at(wi);
    s.pdf = chosen.at(wi).pdf;
    s.whole_f = dark.f, s.whole_pdf = dark.pdf;
    return s;
  };
  return {at, lobe.albedo()};
}

/// A wall that has no inside: what one interface reflects, from either side; the rest goes through
/// as a mirror image of reflection by facets that are as much narrower as a slab of that index
/// makes them: 0.65 n - 0.35, a choice of the model.
SeenLobe seen_wall(const Values& in, Vec wo, bool) {
  const double index = in.index;
  const reference::FacetReflection back(facets(in), wo,
                                        [=](double c) { return reference::fresnel(c, index); });
  reference::Facets thin = facets(in);
  thin.alpha_x = thin.alpha_y = in.alpha_x * std::min(0.65 * index - 0.35, 1.0);
  const double whole = reference::facet_light(thin, wo, 1.0, [](double) { return 1.0; }).reflected;
  const double reflected = back.albedo(), tint = in.color;
  const auto at = [=](Vec wi) {
    Scattered s = back.at(wi);
    // By how much of the light the lobe that is sampled is chosen is a choice of the model.
    s.whole_pdf = s.pdf;
    s.f *= tint, s.pdf *= reflected;
    if (!(wi.z < 0.0)) return s;
    const Vec mirrored{wi.x, wi.y, -wi.z};
    const Vec h = reference::unit(wo + mirrored);
    const double pdf = thin.visible(wo, h) / (4.0 * dot(wo, h));
    const double shadowing = thin.seen_from_both(wo, mirrored) * (1.0 + thin.lambda(wo));
    return Scattered{.f = tint * (1.0 - reflected) * pdf * shadowing / whole,
                     .pdf = (1.0 - reflected) * pdf,
                     .whole_pdf = pdf};
  };
  return {at, tint};
}

double width_of(const Values& in, Vec wo, Vec wi, bool) {
  const Vec other{wi.x, wi.y, std::abs(wi.z)};
  const Vec sum = wo + other;
  return 0.5 * std::sqrt(dot(sum, sum)) * std::min(in.alpha_x, in.alpha_y) * 0.3;
}
double width_of_glass(const Values& in, Vec wo, Vec wi, bool) {
  const Vec sum = wo + (wi.z < 0.0 ? in.index : 1.0) * wi;
  return 0.5 * std::sqrt(dot(sum, sum)) / in.index * in.alpha_x;
}

/// Back, or through, by a facet of the slopes of GGX: bent, or as a wall lets it pass.
template <bool transmits, bool bends>
Vec toward(Random& random, const Values& in, Vec wo, bool) {
  for (int attempt = 0; attempt < 20; ++attempt) {
    const double u = uniform(random), phi = 2.0 * std::numbers::pi * uniform(random);
    const double r = in.alpha_x * std::sqrt(u / (1.0 - u));
    const Vec h = reference::unit({r * std::cos(phi), r * std::sin(phi), 1.0});
    const double c = dot(wo, h);
    if (c <= 0.0) continue;
    const Vec wi = 2.0 * c * h - wo;
    if (transmits && random.chance(0.5)) {
      if (!bends && wi.z > 0.0) return {wi.x, wi.y, -wi.z};
      const double inner = std::sqrt(in.index * in.index - (1.0 - c) * (1.0 + c));
      const Vec bent = (1.0 / in.index) * ((c - inner) * h - wo);
      if (bends && bent.z < 0.0) return bent;
    }
    if (wi.z > 0.0) return wi;
  }
  return draw_above(random);
}

Ports rough(In in, Ports ports) {
  ports["roughness"] = roughness(in.alpha_x, in.alpha_x);
  return ports;
}
Ports filmed(In in, Ports ports) {
  ports["thinfilm_thickness"] = number(in.film_thickness);
  ports["thinfilm_ior"] = number(in.film_index);
  return rough(in, std::move(ports));
}
Ports metal(In in) { return {{"ior", colour(in.index)}, {"extinction", colour(in.extinction)}}; }
Ports glass(In in, const char* mode) {
  return {{"tint", colour(in.color)}, {"ior", number(in.index)}, {"scatter_mode", text(mode)}};
}

}  // namespace

// Gates are what bench/results/lobes.md has: orders of interference that are left out, and mean
// Fresnel factors by two cosines.
std::vector<OracleCase> film_cases() {
  return {
      {.name = "conductor_bsdf, film",
       .category = "conductor_bsdf",
       .ports = [](In in) { return filmed(in, metal(in)); },
       .seen = seen_filmed,
       .draw = draw_filmed_metal,
       .toward = toward<false, false>,
       .width = width_of,
       .standard = {0.1, 1e-4},
       .fast = {0.16, 1e-3},
       .albedo = 0.11},
      {.name = "dielectric_bsdf R, film",
       .category = "dielectric_bsdf",
       .ports = [](In in) { return filmed(in, glass(in, "R")); },
       .seen = seen_filmed,
       .draw = draw_filmed_glass,
       .toward = toward<false, false>,
       .width = width_of,
       .standard = {3.5e-2, 1e-4},
       .fast = {4e-2, 1e-3},
       .albedo = 2.5e-2},
      {.name = "dielectric_bsdf RT, film",
       .category = "dielectric_bsdf",
       .ports = [](In in) { return filmed(in, glass(in, "RT")); },
       .seen = seen_filmed_glass,
       .draw = draw_filmed_glass,
       .toward = toward<true, true>,
       .width = width_of_glass,
       .standard = {1.5e-2, 3e-3},
       .fast = {4e-2, 1e-2}},
      {.name = "dielectric_bsdf RT, thin-walled",
       .category = "dielectric_bsdf",
       .ports = [](In in) { return rough(in, glass(in, "RT")); },
       .seen = seen_wall,
       .draw = draw_wall,
       .toward = toward<true, false>,
       .width = width_of,
       .standard = {1.6e-2, 1.2e-2},
       .fast = {1.6e-2, 1.2e-2},
       .thin_walled = true},
  };
}

}  // namespace nacre
