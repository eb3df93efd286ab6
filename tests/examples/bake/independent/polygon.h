#pragma once

#include <vector>

namespace nacre::independent {

struct Corner {
  double x = 0.0;
  double y = 0.0;
};

/// A convex polygon, its corners in order.
using Polygon = std::vector<Corner>;

/// What of a polygon lies where a x + b y <= c.
Polygon clipped(const Polygon& polygon, double a, double b, double c);

/// Half the sum of the corners' cross products, whichever way round they are.
double area(const Polygon& polygon);

}  // namespace nacre::independent
