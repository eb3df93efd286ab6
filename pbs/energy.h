#pragma once

#include "pbs/facet_distribution.h"
#include "pbs/fresnel.h"
#include "runtime/program/recorder.h"

namespace nacre {

/// How much light the lobes of facets send back to a view, from the tables in
/// pbs/tables, and what single scattering loses.
///
/// Most tables are for equal roughness on both axes; where it is not, they are looked up with the
/// root mean square of the two, at the angle where that masks as much as the surface masks itself.
/// Reflection has a table for unequal roughness besides: a view sees slopes along it and across it,
/// and how far these hang together where the surface is turned. What it adds to a surface that is
/// everywhere as rough as this one along the view is nearly linear in the square of their
/// correlation. Furnace error of a white metal: 1 %, 2 % where it is anisotropic. What passes
/// unequal facets comes from pbs/facet_sum.h instead.
struct FacetView {
  FacetDistribution distribution = FacetDistribution::ggx;
  Float cosine;  ///< Of the view to the normal, in [0, 1].
  Float masked;  ///< The cosine that is masked as much at roughness `alpha`; in [0, 1].
  Float alpha;   ///< In [1e-4, 1].
  /// Only where anisotropic:
  bool anisotropic = false;
  Float along = 1.0f, across = 1.0f;  ///< Roughness along the view, and across it.
  Float correlation2 = 0.0f;          ///< Of slopes along and across, squared; in [0, 1].
  Float stretch = 0.0f;               ///< facet_stretch().
};
template <class F>
void visit(FacetView& view, F&& f) {
  f(view.masked), f(view.along), f(view.across), f(view.correlation2);  // The rest: the surface.
}
FacetView facet_view(Float3 wo, FacetDistribution distribution, Float2 alpha, bool isotropic);

/// How unequal roughnesses are: 0 where they are equal, 1 from a ratio of 0.95 on.
Float facet_stretch(Float2 alpha);

/// What becomes of the light at a rough interface between dielectrics (pbs/facet_sum.h).
struct FacetSum {
  Float reflected = 0.0f;  ///< Albedo of reflection without a Fresnel factor.
  Float fresnel = 0.0f;    ///< Its mean over that light.
  Float passed = 0.0f;     ///< Albedo of transmission without it.
  Float total = 0.0f;      ///< Of both with it.
  Float turned = 0.0f;     ///< Of the facets that reflect all light.
};
template <class F>
void visit(FacetSum& sum, F&& f) {
  f(sum.reflected), f(sum.fresnel), f(sum.passed), f(sum.total), f(sum.turned);
}
/// From a to b where t is 1.
FacetSum lerp(const FacetSum& a, const FacetSum& b, Float t);

/// Measured against quadrature (tests/pbs/energy_test.cpp: alpha 0.01 to 1, cosines from 0.05):
/// albedo of perfect facets 0.4 %; times Fresnel, with for_dielectric()'s cosines, 0.7 % of the
/// light for indices of 1.05 to 2.5. Of unequal roughness, to a ratio of 0.1, 1 % of either, for
/// indices of 1.33 to 2.5.
struct FacetReflection {
  Float albedo;  ///< Of perfectly reflecting facets, in (0, 1].
  /// Facet cosines for the darker and the brighter half of the reflected light.
  Float low, high;
  /// Only where a dielectric's facets are summed (pbs/facet_sum.h):
  FacetSum sum = {};
  Float summed = 0.0f;  ///< How far to trust its mean Fresnel factor rather than tables, in [0, 1].
  /// Only of other curves than a dielectric's, where light leaves:
  Color3 rest = Color3(0.0f);  ///< The mean of what they are more than that.
  Float rest_share = 0.0f;     ///< How far to trust it rather than two cosines, in [0, 1].

  /// The mean of a Fresnel factor over the reflected light: f(Float) -> Float or Color3.
  template <class F>
  auto mean(F&& f) const {
    using Factor = decltype(f(low));
    return (f(low) + f(high)) * Factor(0.5f);
  }
};
template <class F>
void visit(FacetReflection& reflection, F&& f) {
  f(reflection.albedo), f(reflection.low), f(reflection.high);
  visit(reflection.sum, f), f(reflection.summed);
  visit(reflection.rest, f), f(reflection.rest_share);
}
FacetReflection facet_reflection(Recorder& recorder, const FacetView& view);

/// How much steeper at grazing than others Fresnel's factor is of that index, at least 1: 0
/// from 1.31 on. `bare`: how far no film makes it another, in [0, 1].
Float steepness(Float index, Float bare = 1.0f);

/// The same with cosines for Fresnel's factor of an index of that steepness.
FacetReflection for_dielectric(Recorder& recorder, const FacetView& view,
                               const FacetReflection& reflection, Float steepness);

/// An interface between two dielectrics, eta the index beyond over before. Glass
/// of index 1.1 to 2.5 and alpha 0.05 to 1 returns all light to within 1 %, from outside and from
/// inside, layered or joint, to 89.9 degrees (bench/results/furnace.md); 2 % with Beckmann's
/// facets. What is beyond: bench/results/lobes.md. The tables end with index 50.
struct FacetInterface {
  Float fresnel;       ///< Mean Fresnel factor of the reflected light.
  Float transmission;  ///< Albedo of transmission without a Fresnel factor.
  Float total;         ///< Albedo of reflection and transmission, both with it.
  Float turned;        ///< Albedo of the facets that reflect all light.
};
template <class F>
void visit(FacetInterface& interface, F&& f) {
  f(interface.fresnel), f(interface.transmission), f(interface.total), f(interface.turned);
}
/// eta < 1: total reflection from some angle on. `perfect` is facet_reflection's albedo.
FacetInterface facet_leaving(Recorder& recorder, const FacetView& view, Float eta, Float perfect);
/// eta >= 1; leaves `fresnel` 0, which facet_reflection's cosines give.
FacetInterface facet_entering(Recorder& recorder, const FacetView& view, Float eta);

/// Factor for a lobe whose facets have mean Fresnel factor `fresnel`, so that what
/// is lost to several scatterings comes back as often as the facets reflect:
/// 1 + F (1 - E) / E. Turquin, "Practical multiple scattering compensation for
/// microfacet models", 2019, eq. 16, with F of this view in place of F0: exact
/// for white, and no second evaluation of the Fresnel factor.
Float compensation(Float fresnel, Float albedo);
Color3 compensation(Color3 fresnel, Float albedo);

}  // namespace nacre
