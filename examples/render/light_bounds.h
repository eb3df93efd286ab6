#pragma once

#include "examples/render/bounds.h"

namespace nacre::host {

/// Where lights are chosen for.
struct LitPlace {
  Vec3 P;            ///< World.
  Vec3 normal = {};  ///< World, unit, on either side of a surface; 0: of a volume or a fibre.
};

/// Directions within theta_o of an axis. An angle is its cosine and its sine: either alone has no
/// digits somewhere.
struct DirectionCone {
  Vec3 axis = {0.f, 0.f, 1.f};  ///< World, unit.
  float cos_o = 1.f, sin_o = 0.f;

  /// About an axis; `cosine` within [-1, 1].
  static DirectionCone about(Vec3 axis, float cosine);
  static DirectionCone all() { return about({0.f, 0.f, 1.f}, -1.f); }

  bool is_all() const { return cos_o <= -1.f; }
};

/// One that holds both, the narrowest up to rounding.
DirectionCone united(const DirectionCone& a, const DirectionCone& b);

/// What is known of a light, or of a group of them: where it is and what it sends where. Conty
/// Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting",
/// section 4.1.
struct LightBounds {
  Bounds box;  ///< World.
  /// Radiant intensity along the axis, as luminance (W/sr, or candela), summed over the group. 0:
  /// dark.
  double intensity = 0.0;
  /// Axes: normals of surfaces, aims of spots.
  DirectionCone cone = DirectionCone::all();
  /// Cosine of theta_e: nothing leaves at more than this angle from an axis.
  float cos_e = -1.f;
  bool both_ways = false;  ///< The same leaves about the opposite axes.
  /// Nothing arrives that far from it; infinite: no such bound.
  float reach = INFINITY;

  bool is_dark() const { return !(intensity > 0.0); }
};

LightBounds united(const LightBounds& a, const LightBounds& b);

/// The integral over the directions that light leaves in of the cosine to the nearest axis, in
/// steradians (equation 1 there); twice that for both ways, at most 4 pi.
double orientation_measure(const LightBounds& bounds);

/// How much light may arrive, at most, and about: intensity over the squared distance of the box,
/// times cosines at the light and at the place, where the box and the cone make them largest. Not
/// exact for a group. 0 only where nothing arrives: where the place is beyond the reach, or outside
/// of the directions that light leaves in, but for roundings. A normal is that of the geometry, and
/// materials have others: its cosine counts as 0.05 at least, on both sides.
double importance(const LightBounds& bounds, const LitPlace& at);

}  // namespace nacre::host
