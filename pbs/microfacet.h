#pragma once

#include "pbs/view.h"
#include "runtime/value/vector.h"

namespace nacre {

/// GGX microfacets in the local frame of a surface: x and y along the axes of
/// anisotropy, z the normal, directions unit and pointing away from the surface.
/// Roughness alpha in [1e-4, 1] on each axis. Trowbridge and Reitz 1975; Walter
/// et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007;
/// Heitz, "Understanding the Masking-Shadowing Function", JCGT 3(2), 2014.
///
/// Masking uses both roughnesses. MaterialX's own code takes sqrt(ax ay) there,
/// which is not the Smith function of its normal distribution: its visible
/// normals would not be a density.

/// Normals per area and solid angle; h of any length, above the surface or below.
Float ggx_distribution(Float3 h, Float2 alpha);
/// `scale` of the same, of equal roughness: of h by the square of what it has along the surface,
/// what it has along the normal, and its squared length.
Float ggx_distribution(Float across2, Float z, Float length2, Float alpha, float scale);

/// sqrt(ax^2 wx^2 + ay^2 wy^2 + wz^2): z (1 + 2 Lambda). Smith's masking is
/// G1 = 2 z / (z + root) without a division by z.
Float ggx_root(Float3 w, Float2 alpha);
Float ggx_root(Float z, Float alpha);
Float ggx_masking(Float3 w, Float2 alpha);

/// Shadowing of the light given that the facet is seen: G2 / G1 with the
/// height-correlated G2 = 1 / (1 + Lambda_o + Lambda_i). Cosines at least 0.
Float smith_shadowing(Float cos_o, Float root_o, Float cos_i, Float root_i);

/// A facet normal of density D G1 (wo.h) / wo.z, seen from wo above the surface.
/// Dupuy and Benyoub, "Sampling Visible GGX Normals with Spherical Caps", HPG 2023. `root`:
/// ggx_root of wo.
Float3 sample_visible_normal(Float3 wo, Float2 alpha, Float root, Float u, Float v);

/// As sample_visible_normal, less most of the normals that would reflect below
/// the surface: the density is that times (wo.z + root) / (bound wo.z + root).
/// Eto and Tokuyoshi, "Bounded VNDF Sampling for Smith-GGX Reflections", SIGGRAPH
/// Asia 2023. `bound` is reflection_bound(wo, alpha). Of any length, for reflect_about().
Float reflection_bound(Float3 wo, Float2 alpha);
Float reflection_bound(Float z, Float alpha);
Float3 sample_reflecting_normal(Float3 wo, Float2 alpha, Float root, Float bound, Float u, Float v);

/// 2 (w.h) h - w.
Float3 reflect(Float3 w, Float3 h);
/// The same of h of any length: without a root.
Float3 reflect_about(Float3 w, Float3 h);

}  // namespace nacre
