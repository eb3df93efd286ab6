#pragma once

#include <array>

#include "tests/pbs/independent/vector.h"

namespace nacre::reference {

/// A fibre along x. Ways of light: R, TT, TRT, and of the longer ones the last's.
struct Fibre {
  double index = 1.55;
  std::array<double, 3> variance{0.0065, 0.0016, 0.026};
  std::array<double, 3> scale{0.04, 0.04, 0.04};  ///< Chiang's s.
  double tilt = 0.0;                              ///< Of the cuticle, in radians.
  double absorption = 0.0;                        ///< Per radius.
};

/// Of the light along wo what a way has, and where it goes: elevation and azimuth about the fibre
/// of the middle of the way.
struct Way {
  double share, elevation, azimuth;
};

/// Chiang, Bitterli, Tappan and Burley, "A Practical and Controllable Hair and Fur Model for
/// Production Path Tracing", Eurographics 2016, where z says on which part of the fibre the point
/// is, seen along one wo above and not along the fibre.
class Hair {
 public:
  Hair(const Fibre& fibre, Vec wo);
  Scattered at(Vec wi) const;
  double albedo() const;
  const std::array<Way, 4>& ways() const { return ways_; }

 private:
  Fibre fibre_;
  std::array<Way, 4> ways_;
};

}  // namespace nacre::reference
