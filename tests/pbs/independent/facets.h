#pragma once

#include <functional>

#include "tests/pbs/independent/vector.h"

namespace nacre::reference {

/// A rough surface, by the slopes of its facets; directions in its frame. Heitz, "Understanding the
/// Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 3(2), 2014.
struct Facets {
  bool beckmann = false;  ///< Else GGX.
  double alpha_x = 1.0, alpha_y = 1.0;

  /// Normals per area and solid angle; h unit. Eq. 83 and 85.
  double density(Vec h) const;
  /// What is masked over what is seen, of either side. Eq. 66, 72 and 80.
  double lambda(Vec w) const;
  /// Height-correlated masking and shadowing; of refraction too, as the lobes have it. Eq. 99.
  double seen_from_both(Vec wo, Vec wi) const;
  /// Visible normals by solid angle, given wo above. Eq. 3.
  double visible(Vec wo, Vec h) const;
};

/// What becomes of the light of a view at all facets, as a share: sums over slopes.
struct FacetLight {
  double reflected = 0.0;  ///< By facets that reflect all of it: E.
  double fresnel = 0.0;    ///< By facets that reflect what their Fresnel factor says.
  double passed = 0.0;     ///< By facets that let all pass that can.
  double both = 0.0;       ///< With the factor, back and through.
  double turned = 0.0;     ///< Part of `reflected`: by facets under total reflection.
};
/// `index`: beyond over before. `factor`: by the cosine to the facet.
FacetLight facet_light(const Facets& facets, Vec wo, double index,
                       const std::function<double(double)>& factor);

}  // namespace nacre::reference
