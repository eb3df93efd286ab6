#pragma once

#include <algorithm>

#include "pbs/facets.h"

namespace nacre {

/// A facet of a sum.
struct VisibleFacet {
  Float3 normal;  ///< In the frame of the surface, of any length.
  Float inverse;  ///< One over that length.
  Float cosine;   ///< To the view, in [0, 1].
  Float share;    ///< Of all that the view sees.
};

/// The facets that a view sees, for sums over them; where light leaves the denser side those only
/// that let it pass, so that no sum ends in the middle of a lobe.
///
/// Stretched to roughness 1 the facet m that is seen along s lies at y in the plane that touches
/// the sphere there: m ~ s + y.x level + y.y up. The part of the view along it over the length of
/// its normal in the surface's frame, a quadratic form of y, is its cosine to the view: what lies
/// within the angle of total reflection is an ellipse around the facet that faces the view. What is
/// above the surface is a half-plane upwards. Visible normals of GGX have the density
/// 2 / (pi (1 + s.z) (1 + y^2)^2) there (a cap of the sphere in other coordinates: Dupuy and
/// Benyoub, "Sampling Visible GGX Normals with Spherical Caps", HPG 2023): uniform in
/// y.x / sqrt(1 + y.x^2) over the whole plane, and nearly so in y.y / sqrt(1 + y^2). These are the
/// sides of a square. Beckmann's are weighted by what they are more or less dense.
///
/// The points in the square are those of a lattice, made periodic on both sides by 3 u^2 - 2 u^3
/// (Sloan and Joe, "Lattice Methods for Multiple Integration", 1994, section 2.12): two on each
/// line up through the ellipse, which have its ends in common. From line to line they go on by the
/// Fibonacci number before that of the lines, which spreads them evenly (Niederreiter, "Random
/// Number Generation and Quasi-Monte Carlo Methods", 1992, section 5.1).
class VisibleFacets {
 public:
  /// wo: above the surface, in its frame. eta: the index beyond over that on the viewer's side.
  VisibleFacets(Float3 wo, const Facets& facets, Float eta);

  /// Of a sum, Fibonacci numbers. Few do for all facets; those that let light pass end steeply.
  struct Lines {
    int few, many;
  };
  /// add(facet, sum) for each of two on a line.
  template <class Sum, class F>
  Sum sum(Recorder& recorder, Lines lines, Bool many, const Sum& start, F&& add) const {
    return loop(recorder, Bool(true), std::max(lines.few, lines.many), start, [&](Int k, Sum& sum) {
      const Line line = this->line(k, lines, many);
      for (const Periodic& u : line.points) add(at(line, u), sum);
      return k + Int(1) < select(many, Int(lines.many), Int(lines.few));
    });
  }

 private:
  /// A number of the lattice, and how dense it is there.
  struct Periodic {
    Float at, weight;
  };
  static Periodic periodic(Float u);
  struct Line {
    Float3 normal;     ///< Where the line meets the level.
    Float away;        ///< From the centre of the sphere.
    Float low, width;  ///< Of the square's second side.
    Periodic points[2];
    Float share;
  };
  Line line(Int k, Lines lines, Bool many) const;
  VisibleFacet at(const Line& line, const Periodic& u) const;

  FacetDistribution distribution_;
  Float length_;                        ///< Of the stretched view.
  Float3 s_, level_, up_;               ///< In the frame of the surface.
  Float middle_level_, middle_up_;      ///< Of the ellipse.
  Float form_level_, form_up_, shear_;  ///< What squares of y count; where lines have their middle.
  Float within_;                        ///< What they count at its border.
  Float low_, width_;                   ///< Of the square's first side.
  Float lowest_;                        ///< Above the surface, up.
  Float scale_;                         ///< Of a share.
};

}  // namespace nacre
