#pragma once

#include "pbs/facet_distribution.h"
#include "pbs/fresnel.h"
#include "runtime/program/recorder.h"

namespace nacre {

/// How much light the lobes of facets send back to a view, from the tables in
/// pbs/tables, and what single scattering loses.
///
/// What facets lose hangs on how much of them is masked, and little on the azimuth: an
/// anisotropic surface looks up the albedo of a view along its wider axis and of one
/// across it that are masked as much, and goes from one to the other with the narrower
/// axis' part in the masking. All other tables are for equal roughness on both axes: there it
/// looks up the root mean square of its two, at the angle where that masks as much as it
/// masks itself. Furnace error of a white metal: 1 %, 2 % where it is anisotropic. Of anisotropic
/// facets the mean Fresnel factor, and all that passes, come from pbs/facet_sum.h instead.
struct FacetView {
  FacetDistribution distribution = FacetDistribution::ggx;
  Float cosine;  ///< Of the view to the normal, in [0, 1].
  Float masked;  ///< The cosine that is masked as much at roughness `alpha`; in [0, 1].
  Float alpha;   ///< In [1e-4, 1].
  /// Only where anisotropic:
  bool anisotropic = false;
  Float wide_masked = 0.0f;  ///< As `masked`, at the wider roughness.
  Float wide = 1.0f;         ///< The wider roughness.
  Float ratio = 1.0f;        ///< The narrower over it.
  Float across = 0.0f;       ///< Part of the masking that the narrower axis has, in [0, 1].
};
template <class F>
void visit(FacetView& view, F&& f) {
  f(view.masked), f(view.wide_masked), f(view.across);  // The rest is of the surface.
}
FacetView facet_view(Float3 wo, FacetDistribution distribution, Float2 alpha, bool isotropic);

/// Measured against quadrature (tests/pbs/energy_test.cpp: alpha 0.01 to 1, cosines from 0.05):
/// albedo of perfect facets 0.4 %; times Fresnel, with for_dielectric()'s cosines, 0.7 % of the
/// light for indices of 1.05 to 2.5.
struct FacetReflection {
  Float albedo;  ///< Of perfectly reflecting facets, in (0, 1].
  /// Facet cosines for the darker and the brighter half of the reflected light.
  Float low, high;
  /// Only where anisotropic (pbs/facet_sum.h):
  Float low_share = 0.5f;   ///< Part of the light that `low` stands for.
  Float dielectric = 0.0f;  ///< The mean of a dielectric's Fresnel factor, where light leaves it.
  Float summed = 0.0f;      ///< How far to trust `dielectric` rather than tables, in [0, 1].
  /// Only of other curves than a dielectric's, where light leaves:
  Color3 rest = Color3(0.0f);  ///< The mean of what they are more than that.
  Float rest_share = 0.0f;     ///< How far to trust it rather than two cosines, in [0, 1].

  /// The mean of a Fresnel factor over the reflected light: f(Float) -> Float or Color3.
  template <class F>
  auto mean(F&& f) const {
    using Factor = decltype(f(low));
    if (low_share.is_constant(0.5f)) return (f(low) + f(high)) * Factor(0.5f);
    const Factor of_high = f(high), of_low = f(low);
    return fma(of_low - of_high, Factor(low_share), of_high);
  }
};
template <class F>
void visit(FacetReflection& reflection, F&& f) {
  f(reflection.albedo), f(reflection.low), f(reflection.high), f(reflection.low_share);
  f(reflection.dielectric), f(reflection.summed);
  visit(reflection.rest, f), f(reflection.rest_share);
}
FacetReflection facet_reflection(Recorder& recorder, const FacetView& view);

/// The same with cosines for Fresnel's factor of that index, at least 1: the nearer to 1, the
/// steeper it falls from grazing. `bare`: how far no film makes it another, in [0, 1].
FacetReflection for_dielectric(Recorder& recorder, const FacetView& view,
                               const FacetReflection& reflection, Float index, Float bare = 1.0f);

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
