// Writes the table of one distribution of facets to standard output:
//
//   ninja make_facet_tables
//   ./make_facet_tables ggx > pbs/tables/ggx_tables.inc
//   ./make_facet_tables beckmann > pbs/tables/beckmann_tables.inc
//
// Midpoint rule over the unit square that visible normals are sampled from, in double precision:
// GGX by Dupuy and Benyoub, "Sampling Visible GGX Normals with Spherical Caps", 2023; Beckmann by
// the slopes along and across the view, Heitz and d'Eon, "Importance Sampling Microfacet-Based
// BSDFs using the Distribution of Visible Normals", 2014. Half the square is enough: the integrands
// are even.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <string_view>
#include <vector>

#include "pbs/tables/axes.h"

namespace {

constexpr int steps = 256;

struct Vec {
  double x, y, z;
};

/// As a view of the surface sees it: the slopes of facets along the view and across it are as wide
/// as this, and correlated where the surface is turned. Those across: `across` times (correlation x
/// + rest y) of slopes x, which are along the view, and y that are not.
struct Roughness {
  double along, across;
  double correlation = 0.0;

  double rest() const { return std::sqrt((1.0 - correlation) * (1.0 + correlation)); }
  /// What slopes of roughness 1 become.
  Vec stretched(Vec h) const {
    return {along * h.x, across * (correlation * h.x + rest() * h.y), h.z};
  }
  /// How steep the surface is towards a direction.
  double towards(Vec w) const {
    return std::hypot(along * w.x + across * correlation * w.y, across * rest() * w.y);
  }
};

/// Facets of a surface.
class Facets {
 public:
  virtual ~Facets() = default;
  /// z (1 + 2 Lambda) of a direction.
  virtual double root(Vec w, const Roughness& alpha) const = 0;
  /// Calls f(normal of any length) for equally probable normals that are seen from (sine, 0,
  /// cosine), `steps` squared of them: the half of which slopes y are positive.
  using Normal = std::function<void(Vec h)>;
  virtual void each_normal(double sine, double cosine, const Roughness& alpha,
                           const Normal& f) const = 0;
};

class Ggx final : public Facets {
 public:
  double root(Vec w, const Roughness& alpha) const override {
    return std::hypot(alpha.towards(w), w.z);
  }
  void each_normal(double sine, double cosine, const Roughness& alpha,
                   const Normal& f) const override {
    const double length = std::hypot(alpha.along * sine, cosine);
    const double x = alpha.along * sine / length;
    const double z = cosine / length;
    for (int i = 0; i < steps; ++i) {
      const double cap = (1.0 - (i + 0.5) / steps) * (1.0 + z) - z;
      const double ring = std::sqrt(std::max(0.0, 1.0 - cap * cap));
      for (int j = 0; j < steps; ++j) {
        const double phi = std::numbers::pi * (j + 0.5) / steps;
        f(alpha.stretched({x + ring * std::cos(phi), ring * std::sin(phi), z + cap}));
      }
    }
  }
};

/// x in [low, high] with f(x) = y, for an f that grows.
double invert(double y, double low, double high, const std::function<double(double)>& f) {
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (f(middle) < y ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

class Beckmann final : public Facets {
 public:
  Beckmann() {
    for (int j = 0; j < steps; ++j) {
      aside_.push_back(invert((j + 0.5) / steps, 0.0, 6.0, [](double x) { return std::erf(x); }));
    }
  }
  double root(Vec w, const Roughness& alpha) const override {
    const double across = std::max(alpha.towards(w), 1e-300);
    const double ratio = std::abs(w.z) / across;
    return std::abs(w.z) * std::erf(ratio) + across * std::exp(-ratio * ratio) / root_pi;
  }
  void each_normal(double sine, double cosine, const Roughness& alpha,
                   const Normal& f) const override {
    const double length = std::hypot(alpha.along * sine, cosine);
    const double s = alpha.along * sine / length;
    const double c = cosine / length;
    const double steepest = s > 0.0 ? std::min(c / s, 7.0) : 7.0;
    const auto below = [&](double x) {
      return c * root_pi * (1.0 + std::erf(x)) + s * std::exp(-x * x);
    };
    for (int i = 0; i < steps; ++i) {
      const double u = (i + 0.5) / steps;
      const double forth = invert(u * below(steepest), -7.0, steepest, below);
      for (const double aside : aside_) f(alpha.stretched({-forth, aside, 1.0}));
    }
  }

 private:
  static constexpr double root_pi = 1.77245385090551602730;
  std::vector<double> aside_;
};

/// A view of the surface and the light it brings along one visible normal.
struct Scene {
  const Facets& facets;
  double cosine, alpha;
  double sine, root;

  Scene(const Facets& facets_, double cosine_, double alpha_)
      : facets(facets_), cosine(std::clamp(cosine_, 1e-12, 1.0)), alpha(alpha_) {
    sine = std::sqrt(1.0 - cosine * cosine);
    root = facets.root({sine, 0.0, cosine}, {alpha, alpha});
  }

  /// Calls f(facet normal, its cosine to the view) for equally probable normals.
  template <class F>
  void each_normal(F&& f) const {
    facets.each_normal(sine, cosine, {alpha, alpha}, [&](Vec h) {
      const double length = std::sqrt(h.x * h.x + h.y * h.y + h.z * h.z);
      h = {h.x / length, h.y / length, h.z / length};
      f(h, sine * h.x + cosine * h.z);
    });
  }

  /// G2 / G1 for light leaving with this cosine to the surface normal.
  double shadowing(double out) const {
    const double out_root =
        facets.root({std::sqrt(std::max(1.0 - out * out, 0.0)), 0.0, out}, {alpha, alpha});
    return out * (cosine + root) / (out * root + cosine * out_root);
  }
};

/// Unpolarised; Born and Wolf, "Principles of Optics", 1.5.2.
double fresnel(double cosine, double eta) {
  const double squared = eta * eta - 1.0 + cosine * cosine;
  if (squared <= 0.0) return 1.0;
  const double g = std::sqrt(squared);
  const double s = (cosine - g) / (cosine + g);
  const double p = (eta * eta * cosine - g) / (eta * eta * cosine + g);
  return 0.5 * (s * s + p * p);
}

/// What perfect facets send back to a view.
struct Reflected {
  std::vector<std::pair<double, double>> parts;  ///< Facet cosine, light; darker ones first.
  double total = 0.0;
};

Reflected reflected(const Scene& scene) {
  Reflected found;
  scene.each_normal([&](Vec h, double c) {
    const double out = 2.0 * c * h.z - scene.cosine;
    if (out <= 0.0) return;
    found.parts.emplace_back(c, scene.shadowing(out) / (steps * steps));
    found.total += found.parts.back().second;
  });
  std::sort(found.parts.begin(), found.parts.end());
  return found;
}

/// The cosines that stand for the darker and the brighter half of the light, less that of the view:
/// the mean of (1 - cosine)^exponent over a half is exact.
std::vector<double> stand_ins(const Reflected& light, double exponent, double view) {
  double moment[2] = {0.0, 0.0};
  double before = 0.0;
  const double half = 0.5 * light.total;
  for (const auto& [c, part] : light.parts) {
    const double low = std::clamp(half - before, 0.0, part);
    const double rest = std::max(1.0 - c, 0.0);  // Rounding goes beyond.
    moment[0] += low * std::pow(rest, exponent);
    moment[1] += (part - low) * std::pow(rest, exponent);
    before += part;
  }
  const auto cosine = [&](double m) { return 1.0 - std::pow(m / half, 1.0 / exponent) - view; };
  return {cosine(moment[0]), cosine(moment[1])};
}

std::vector<double> reflection(const Facets& facets, double cosine, double alpha, double) {
  const Scene scene(facets, cosine, alpha);
  const Reflected light = reflected(scene);
  // Schlick's 5 and a little more, for the curves of usual indices.
  const std::vector<double> means = stand_ins(light, 5.4, scene.cosine);
  return {light.total, means[0], means[1]};
}

/// For the curves of indices next to 1, which fall within few degrees of grazing.
std::vector<double> steep(const Facets& facets, double cosine, double alpha, double) {
  const Scene scene(facets, cosine, alpha);
  return stand_ins(reflected(scene), 10.0, scene.cosine);
}

/// The same of a surface whose roughness is not equal all around.
std::vector<double> of_turned(const Facets& facets, double cosine, const Roughness& alpha) {
  const double z_o = std::clamp(cosine, 1e-12, 1.0);
  const double sine = std::sqrt((1.0 - z_o) * (1.0 + z_o));
  const double root = facets.root({sine, 0.0, z_o}, alpha);
  // The other half of the normals looks like this one where the surface is turned the other way.
  Reflected light;
  for (const double side : {1.0, -1.0}) {
    const Roughness turned{alpha.along, alpha.across, side * alpha.correlation};
    facets.each_normal(sine, z_o, turned, [&](Vec h) {
      const double length2 = h.x * h.x + h.y * h.y + h.z * h.z;
      const double seen = sine * h.x + z_o * h.z;
      const double twice = 2.0 * seen / length2;
      const Vec out{twice * h.x - sine, twice * h.y, twice * h.z - z_o};
      if (out.z <= 0.0) return;
      const double out_root = facets.root(out, turned);
      const double shadowing = out.z * (z_o + root) / (out.z * root + z_o * out_root);
      light.parts.emplace_back(seen / std::sqrt(length2), shadowing / (2 * steps * steps));
      light.total += light.parts.back().second;
    });
    if (alpha.correlation == 0.0 && side > 0.0) {
      for (auto& part : light.parts) part.second *= 2.0;
      light.total *= 2.0;
      break;
    }
  }
  std::sort(light.parts.begin(), light.parts.end());
  const std::vector<double> means = stand_ins(light, 5.4, z_o);
  return {light.total, means[0], means[1]};
}

/// How much more than of a surface that is everywhere as rough as this one along the view: of
/// slopes that are not correlated, and that are one and the same.
std::vector<double> unequal(const Facets& facets, double cosine, double along, double across) {
  const std::vector<double> equal = of_turned(facets, cosine, {along, along});
  std::vector<double> more;
  for (const double correlation : {0.0, 1.0}) {
    const std::vector<double> all = of_turned(facets, cosine, {along, across, correlation});
    for (std::size_t k = 0; k < all.size(); ++k) more.push_back(all[k] - equal[k]);
  }
  return more;
}

struct Interface {
  double perfect = 0.0, reflected = 0.0, passing = 0.0, transmitted = 0.0, turned = 0.0;
};

Interface interface(const Facets& facets, double cosine, double alpha, double eta) {
  const Scene scene(facets, cosine, alpha);
  Interface sum;
  scene.each_normal([&](Vec h, double c) {
    const double part = 1.0 / (steps * steps);
    const double f = fresnel(c, eta);
    const double squared = eta * eta - 1.0 + c * c;
    if (const double out = 2.0 * c * h.z - scene.cosine; out > 0.0) {
      sum.perfect += part * scene.shadowing(out);
      sum.reflected += part * scene.shadowing(out) * f;
      if (squared <= 0.0) sum.turned += part * scene.shadowing(out);
    }
    if (squared <= 0.0) return;
    const double down = (scene.cosine - (c - std::sqrt(squared)) * h.z) / eta;
    if (down <= 0.0) return;
    sum.passing += part * scene.shadowing(down);
    sum.transmitted += part * scene.shadowing(down) * (1.0 - f);
  });
  return sum;
}

std::vector<double> entering(const Facets& facets, double cosine, double alpha, double eta) {
  const Interface sum = interface(facets, cosine, alpha, eta);
  return {sum.passing, sum.reflected + sum.transmitted};
}

std::vector<double> leaving(const Facets& facets, double cosine, double alpha, double eta) {
  const Interface sum = interface(facets, cosine, alpha, 1.0 / eta);
  const double mirror = nacre::table_axes::mirror_share(alpha) * fresnel(cosine, 1.0 / eta);
  return {sum.reflected / sum.perfect - mirror, sum.passing,
          (sum.reflected + sum.transmitted) / sum.perfect, sum.turned / sum.perfect};
}

double angle_below_one(double cosine, double alpha, double eta) {
  namespace axes = nacre::table_axes;
  const double critical = axes::critical_cosine(1.0 / eta);
  return cosine < critical ? axes::beyond_critical(cosine, alpha, critical)
                           : axes::within_critical(cosine, alpha, critical);
}

double angle(double cosine, double alpha, double) {
  return nacre::table_axes::angle(cosine, alpha);
}

double entering_angle(double cosine, double alpha, double) {
  return nacre::table_axes::entering_angle(cosine, alpha);
}

using Integral = std::vector<double> (*)(const Facets&, double, double, double);
using Axis = double (*)(double, double, double);

/// On the third axis the roughness across the view.
void write_unequal(const Facets& facets, const char* name, int angles, int roughnesses) {
  const auto alpha_at = [&](int k) {
    return std::max(std::pow(double(k) / (roughnesses - 1), 2), 1e-6);
  };
  std::printf("constexpr float %s[] = {\n", name);
  for (int k = 0; k < roughnesses; ++k) {
    for (int j = 0; j < roughnesses; ++j) {
      const double along = alpha_at(j), across = alpha_at(k);
      for (int i = 0; i < angles; ++i) {
        const double cosine = invert(double(i) / (angles - 1), 0.0, 1.0, [&](double c) {
          return nacre::table_axes::unequal_angle(c, along, across);
        });
        for (const double value : unequal(facets, cosine, along, across)) {
          std::printf("%#.5gf,", value);
        }
      }
      std::printf("\n");
    }
  }
  std::printf("};\n");
}

void write(const Facets& facets, const char* name, int angles, int roughnesses, int indices,
           Axis axis, Integral f) {
  std::printf("constexpr float %s[] = {\n", name);
  for (int k = 0; k < indices; ++k) {
    const double root = nacre::table_axes::last_root * k / (indices - 1);
    const double offset = indices == 1 ? 0.0 : root * root;
    const double eta = std::max((1.0 + offset) / (1.0 - offset), 1.0 + 1e-6);
    for (int j = 0; j < roughnesses; ++j) {
      const double alpha = std::max(std::pow(double(j) / (roughnesses - 1), 2), 1e-8);
      for (int i = 0; i < angles; ++i) {
        const double cosine = invert(double(i) / (angles - 1), 0.0, 1.0,
                                     [&](double c) { return axis(c, alpha, eta); });
        for (const double value : f(facets, cosine, alpha, eta)) std::printf("%#.5gf,", value);
      }
      std::printf("\n");
    }
  }
  std::printf("};\n");
}

}  // namespace

int main(int count, char** arguments) {
  const std::string_view name = count == 2 ? arguments[1] : "";
  const Ggx ggx;
  const Beckmann beckmann;
  if (name != "ggx" && name != "beckmann") {
    std::fprintf(stderr, "usage: make_facet_tables ggx|beckmann\n");
    return 1;
  }
  const Facets& facets = name == "ggx" ? static_cast<const Facets&>(ggx) : beckmann;
  std::printf("// Written by pbs/tables/make_tables.cpp.\n");
  write(facets, "reflection_values", 24, 20, 1, angle, reflection);
  write(facets, "steep_values", 24, 20, 1, angle, steep);
  write(facets, "entering_values", 40, 20, 10, entering_angle, entering);
  write(facets, "leaving_values", 40, 16, 30, angle_below_one, leaving);
  write_unequal(facets, "unequal_values", 32, 12);
}
