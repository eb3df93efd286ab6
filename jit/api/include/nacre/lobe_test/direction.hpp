/// \file
/// Directions about a normal z: part of <nacre/lobe_test.hpp>.
#ifndef NACRE_LOBE_TEST_DIRECTION_HPP
#define NACRE_LOBE_TEST_DIRECTION_HPP

#include <cmath>

namespace nacre {
inline namespace v0 {

struct Direction {
  float x, y, z;
};

/// Unit, at `degrees` from the normal z; beyond 90 below the surface.
inline Direction direction(double degrees, double azimuth_degrees = 30.0) {
  constexpr double degree = 3.14159265358979323846 / 180.0;
  const double theta = degrees * degree;
  const double phi = azimuth_degrees * degree;
  return {static_cast<float>(std::sin(theta) * std::cos(phi)),
          static_cast<float>(std::sin(theta) * std::sin(phi)), static_cast<float>(std::cos(theta))};
}

}  // namespace v0
}  // namespace nacre

#endif
