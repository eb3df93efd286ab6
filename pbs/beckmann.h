#pragma once

#include "runtime/value/vector.h"

namespace nacre {

/// Beckmann's microfacets, whose slopes are normally distributed, as pbs/microfacet.h has those of
/// GGX: the same frame, directions and roughness. Walter et al., "Microfacet Models for Refraction
/// through Rough Surfaces", EGSR 2007, eq. 25; Heitz, "Understanding the Masking-Shadowing Function
/// in Microfacet-Based BRDFs", JCGT 3(2), 2014, eq. 66. Masking is erf's, to 2e-7, and not Walter's
/// rational fit.

/// Normals per area and solid angle; h of any length, above the surface or below.
Float beckmann_distribution(Float3 h, Float2 alpha);
/// As ggx_distribution() of equal roughness.
Float beckmann_distribution(Float across2, Float z, Float length2, Float alpha);

/// z (1 + 2 Lambda), as ggx_root: everything that is made of that holds for it.
Float beckmann_root(Float3 w, Float2 alpha);
Float beckmann_root(Float z, Float alpha);

/// A facet normal of density D G1 (wo.h) / wo.z, seen from wo above the surface. Heitz and d'Eon,
/// "Importance Sampling Microfacet-Based BSDFs using the Distribution of Visible Normals", EGSR
/// 2014; the slope along the view from Jakob's guess ("An Improved Visible Normal Sampling Routine
/// for the Beckmann Distribution", 2014), by two steps of Halley's for his Newton's.
Float3 sample_visible_beckmann(Float3 wo, Float2 alpha, Float u, Float v);

}  // namespace nacre
