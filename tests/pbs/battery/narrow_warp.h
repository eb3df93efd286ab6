#pragma once

#include <cstddef>
#include <memory>
#include <nacre/lobe_test/direction.hpp>

namespace nacre {

/// Directions by where they lie in a narrow lobe: mapped to one sphere or more on which the lobe,
/// seen from one wo, is as wide as the sphere. All in double; normal z, tangent x.
class NarrowWarp {
 public:
  virtual ~NarrowWarp() = default;

  struct Place {
    std::size_t sphere;
    Direction on;  ///< Unit.
  };
  virtual Place place(Direction wi) const = 0;

  struct Back {
    Direction wi;
    double scale;  ///< Solid angle about wi over that on the sphere; 0: no such direction.
  };
  virtual Back back(Place place) const = 0;

  virtual std::size_t spheres() const = 0;
};

/// The slope of the half-way vector over alpha, on the sphere by stereographic projection: GGX seen
/// along its normal is uniform there. One sphere of what is reflected, one of what passes;
/// `index`: of what the normal points away from, over the other. `turned`: what is reflected
/// lies half round the normal.
std::unique_ptr<NarrowWarp> facet_warp(Direction wo, double alpha_x, double alpha_y, double index,
                                       bool turned);

/// theta - theta_spec over the root of the variance and phi - phi_spec over the logistic's scale
/// of each way through a fibre along x (Marschner et al. 2003), as the mean of Cauchy
/// distributions about them.
struct FibreWidths {
  double variance[3], scale[3];  ///< R, TT, TRT.
  double tilt;                   ///< Of the cuticle, radians.
  double index;
};
std::unique_ptr<NarrowWarp> fibre_warp(Direction wo, const FibreWidths& widths);

}  // namespace nacre
