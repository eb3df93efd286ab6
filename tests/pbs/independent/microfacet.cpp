#include "tests/pbs/independent/microfacet.h"

#include <algorithm>
#include <utility>

#include "tests/pbs/independent/fresnel.h"

namespace nacre::reference {

FacetLobe::Event FacetLobe::between(Vec wi, double index) const {
  Event event;
  const Vec sum = wo_ + index * wi;
  if (dot(sum, sum) == 0.0) return event;
  const Vec upward = sum.z < 0.0 ? -1.0 * sum : sum;
  const Vec h = unit(upward);
  const double cos_o = dot(wo_, h), cos_i = dot(wi, h);
  // A facet shows both its directions the sides that the surface shows them.
  if (cos_o <= 0.0 || cos_i * wi.z <= 0.0) return event;
  const double density = facets_.density(h);
  const double by_solid_angle = index * index * std::abs(cos_i) / dot(sum, sum);
  return {.possible = true,
          .cosine = std::min(cos_o, 1.0),
          .pdf = facets_.visible(wo_, h) * by_solid_angle,
          .light = density * facets_.seen_from_both(wo_, wi) * cos_o / wo_.z * by_solid_angle};
}

FacetReflection::FacetReflection(const Facets& facets, Vec wo, Reflectance reflectance)
    : FacetLobe(facets, wo), reflectance_(std::move(reflectance)) {
  const FacetLight light = facet_light(facets, wo, 1.0, reflectance_);
  const double mean = light.fresnel / light.reflected;
  factor_ = 1.0 + mean * (1.0 - light.reflected) / light.reflected;
  albedo_ = light.fresnel * factor_;
}

Scattered FacetReflection::at(Vec wi) const {
  if (wi.z <= 0.0) return {};
  const Event event = between(wi, 1.0);
  if (!event.possible) return {};
  double pdf = event.pdf;
  if (!facets_.beckmann) {
    // Stretched to a sphere, the normals' cap ends where they would reflect below the surface.
    const double a = std::min(facets_.alpha_x, facets_.alpha_y);
    const double s = 1.0 + std::hypot(wo_.x, wo_.y);
    const double k = (1.0 - a * a) * s * s / (s * s + a * a * wo_.z * wo_.z);
    const double t = std::hypot(facets_.alpha_x * wo_.x, facets_.alpha_y * wo_.y, wo_.z);
    pdf = facets_.density(unit(wo_ + wi)) / (2.0 * (k * wo_.z + t));
  }
  return {.f = event.light * reflectance_(event.cosine) * factor_, .pdf = pdf};
}

FacetTransmission::FacetTransmission(const Facets& facets, Vec wo, double index, bool leaving)
    : FacetLobe(facets, wo), index_(index) {
  const FacetLight light =
      facet_light(facets, wo, index, [&](double cosine) { return fresnel(cosine, index); });
  const double narrow = std::min(facets.alpha_x, facets.alpha_y);
  const double little = std::max(0.2 * (1.0 - narrow), 0.05);
  const double x = std::clamp(light.passed / std::max(light.both, 0.05) / little, 0.0, 1.0);
  turned_ = leaving ? 1.0 - x * x * (3.0 - 2.0 * x) : 0.0;
  factor_ = 1.0 / (light.passed + turned_ * light.turned);
}

Scattered FacetTransmission::at(Vec wi) const {
  const bool reflects = wi.z > 0.0;
  const Event event = between(wi, reflects ? 1.0 : index_);
  if (!event.possible) return {};
  double share = 1.0;
  if (reflects) share = totally_reflected(event.cosine, index_) ? turned_ : 0.0;
  return {.f = event.light * share * factor_,
          .pdf = event.pdf * share,
          .whole_f = event.light * factor_,
          .whole_pdf = event.pdf};
}

FacetInterface::FacetInterface(const Facets& facets, Vec wo, double index, Reflectance reflectance)
    : FacetLobe(facets, wo), index_(index), reflectance_(std::move(reflectance)) {
  factor_ = 1.0 / facet_light(facets, wo, index, reflectance_).both;
}

Scattered FacetInterface::at(Vec wi) const {
  const bool reflects = wi.z > 0.0;
  const Event event = between(wi, reflects ? 1.0 : index_);
  if (!event.possible) return {};
  const double reflected = reflectance_(event.cosine);
  const double share = reflects ? reflected : 1.0 - reflected;
  return {.f = event.light * share * factor_, .pdf = event.pdf * share};
}

}  // namespace nacre::reference
