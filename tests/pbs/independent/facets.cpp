#include "tests/pbs/independent/facets.h"

#include <algorithm>
#include <numbers>

#include "tests/pbs/independent/fresnel.h"

namespace nacre::reference {

namespace {

constexpr double pi = std::numbers::pi;

}  // namespace

double Facets::density(Vec h) const {
  if (h.z <= 0.0) return 0.0;
  const double x = h.x / (h.z * alpha_x), y = h.y / (h.z * alpha_y);
  const double slope2 = x * x + y * y;
  const double of_slopes = beckmann ? std::exp(-slope2) : 1.0 / ((1.0 + slope2) * (1.0 + slope2));
  return of_slopes / (pi * alpha_x * alpha_y * h.z * h.z * h.z * h.z);
}

double Facets::lambda(Vec w) const {
  const double across2 = alpha_x * alpha_x * w.x * w.x + alpha_y * alpha_y * w.y * w.y;
  if (across2 == 0.0) return 0.0;
  const double steepness2 = w.z * w.z / across2;
  if (!beckmann) return 0.5 * (std::sqrt(1.0 + 1.0 / steepness2) - 1.0);
  const double a = std::sqrt(steepness2);
  return 0.5 * (std::exp(-a * a) / (a * std::sqrt(pi)) - std::erfc(a));
}

double Facets::seen_from_both(Vec wo, Vec wi) const {
  return 1.0 / (1.0 + lambda(wo) + lambda(wi));
}

double Facets::visible(Vec wo, Vec h) const {
  return density(h) * std::max(dot(wo, h), 0.0) / ((1.0 + lambda(wo)) * wo.z);
}

FacetLight facet_light(const Facets& facets, Vec wo, double index,
                       const std::function<double(double)>& factor) {
  // Slopes in units of the roughness: r in steps of r / (1 + r), and azimuths, of which one half is
  // as the other where the view is along an axis of symmetry.
  constexpr int radii = 240, azimuths = 160;
  const bool isotropic = facets.alpha_x == facets.alpha_y;
  const double azimuth = isotropic ? std::atan2(wo.y, wo.x) : 0.0;
  FacetLight sum;
  for (int i = 0; i < radii; ++i) {
    const double t = (i + 0.5) / radii;
    const double r = t / (1.0 - t);
    const double tail = facets.beckmann ? std::exp(-r * r) : 1.0 / ((1.0 + r * r) * (1.0 + r * r));
    // Of dr by t, and of the mean over azimuths.
    const double share = 2.0 * r * tail * (1.0 + r) * (1.0 + r) / (radii * azimuths);
    if (share < 1e-18) continue;
    for (int j = 0; j < azimuths; ++j) {
      const double phi = azimuth + (isotropic ? pi : 2.0 * pi) * (j + 0.5) / azimuths;
      const Vec tilted{facets.alpha_x * r * std::cos(phi), facets.alpha_y * r * std::sin(phi), 1.0};
      const double projected = dot(wo, tilted);  // Area of the facet as seen, by that of its base.
      if (projected <= 0.0) continue;
      const Vec h = unit(tilted);
      const double cosine = std::min(dot(wo, h), 1.0);
      const auto light = [&](Vec wi) {
        return share * projected / wo.z * facets.seen_from_both(wo, wi);
      };
      const double reflectance = factor(cosine);
      const bool turns = totally_reflected(cosine, index);
      const Vec back = 2.0 * cosine * h - wo;
      if (back.z > 0.0) {
        const double all = light(back);
        sum.reflected += all;
        sum.fresnel += all * reflectance;
        sum.both += all * reflectance;
        if (turns) sum.turned += all;
      }
      if (turns || index == 1.0) continue;
      const double inner = std::sqrt(index * index - (1.0 - cosine) * (1.0 + cosine));
      const Vec through = (1.0 / index) * ((cosine - inner) * h - wo);
      if (through.z >= 0.0) continue;
      const double all = light(through);
      sum.passed += all;
      sum.both += all * (1.0 - reflectance);
    }
  }
  return sum;
}

}  // namespace nacre::reference
