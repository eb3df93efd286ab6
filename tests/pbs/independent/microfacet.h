#pragma once

#include <functional>

#include "tests/pbs/independent/facets.h"

namespace nacre::reference {

/// Reflectance by the cosine to a facet.
using Reflectance = std::function<double(double)>;

/// A lobe of facets seen along one wo above the surface. What is lost to several scatterings comes
/// back by a factor for the view, here of integrals over all facets, where the lobes look up tables
/// (pbs/energy.h) or sum a few (pbs/facet_sum.h).
class FacetLobe {
 public:
  virtual ~FacetLobe() = default;
  virtual Scattered at(Vec wi) const = 0;
  /// Of the light from wo what leaves again.
  double albedo() const { return albedo_; }

 protected:
  FacetLobe(const Facets& facets, Vec wo) : facets_(facets), wo_(wo) {}
  /// The facet that takes wo to wi, with visible normals sampled; `index` is 1 where it reflects.
  struct Event {
    bool possible = false;
    double cosine = 0.0;  ///< wo to the facet.
    double pdf = 0.0;     ///< Of wi.
    double light = 0.0;   ///< f |cos(wi)| without a Fresnel factor.
  };
  Event between(Vec wi, double index) const;

  Facets facets_;
  Vec wo_;
  double albedo_ = 1.0;
};

/// Cook and Torrance's lobe as Walter et al. 2007 write it ("Microfacet Models for Refraction
/// through Rough Surfaces", EGSR, eq. 20), times 1 + F (1 - E) / E: Turquin, "Practical multiple
/// scattering compensation for microfacet models", 2019, eq. 16, with the mean F of this view.
/// GGX is sampled by Eto and Tokuyoshi, "Bounded VNDF Sampling for Smith-GGX Reflections", SIGGRAPH
/// Asia 2023, eq. 5 and 8; Beckmann by visible normals.
class FacetReflection final : public FacetLobe {
 public:
  FacetReflection(const Facets& facets, Vec wo, Reflectance reflectance);
  Scattered at(Vec wi) const override;

 private:
  Reflectance reflectance_;
  double factor_;
};

/// Walter et al. 2007, eq. 17 and 21, without a Fresnel factor, divided by its integral. Where
/// hardly any light passes, facets reflect what they can't refract: a share of those under total
/// reflection, which goes from 1 to 0 with the smooth step of what passes over what is to come back
/// at all, up to a fifth of 1 - alpha. That share is a choice of the model.
class FacetTransmission final : public FacetLobe {
 public:
  FacetTransmission(const Facets& facets, Vec wo, double index, bool leaving);
  Scattered at(Vec wi) const override;

 private:
  double index_, turned_, factor_;
};

/// Reflection and refraction by the Fresnel factor of each facet, divided by the integral of both.
class FacetInterface final : public FacetLobe {
 public:
  FacetInterface(const Facets& facets, Vec wo, double index, Reflectance reflectance);
  Scattered at(Vec wi) const override;

 private:
  double index_;
  Reflectance reflectance_;
  double factor_;
};

}  // namespace nacre::reference
