#include "nodes/noise/fade.h"

namespace nacre {

namespace {

/// Sum of the squares of what x changes by along both axes.
Float squares(Float x) {
  const Float along = footprint_derivative(x, 0);
  const Float across = footprint_derivative(x, 1);
  return along * along + across * across;
}

// Measured on squares 1/8 to 3 wide. Noise of three dimensions is cut through by a footprint, and
// changes less along it.
constexpr float rate_2d = 0.08f;
constexpr float rate_3d = 0.055f;

}  // namespace

Float covered(Float2 p) { return rate_2d * (squares(p.x) + squares(p.y)); }

Float covered(Float3 p) { return rate_3d * (squares(p.x) + squares(p.y) + squares(p.z)); }

}  // namespace nacre
