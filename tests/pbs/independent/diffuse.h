#pragma once

#include "tests/pbs/independent/vector.h"

namespace nacre::reference {

// Lobes with the density of a cosine; wo above the surface, white unless a colour is given.

/// Lambert's.
Scattered lambert(double colour, Vec wi);

/// Oren and Nayar, "Generalization of Lambert's reflectance model", SIGGRAPH 1994, eq. 30: the
/// qualitative model. `sigma`: standard deviation of the facets' angle in radians.
Scattered oren_nayar(double colour, double sigma, Vec wo, Vec wi);

/// Portsmouth, Kutz and Hill, "EON: A practical energy-preserving rough diffuse BRDF", JCGT 14(1),
/// 2025, listing 1 with the exact albedo; roughness in [0, 1].
Scattered energy_preserving_oren_nayar(double colour, double roughness, Vec wo, Vec wi);

/// Burley, "Physically Based Shading at Disney", SIGGRAPH 2012 course notes, 5.3.
Scattered burley(double colour, double roughness, Vec wo, Vec wi);

}  // namespace nacre::reference
