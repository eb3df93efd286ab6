#include "tests/examples/bake/independent/polygon.h"

#include <cmath>

namespace nacre::independent {

Polygon clipped(const Polygon& polygon, double a, double b, double c) {
  Polygon inside;
  const auto excess = [&](const Corner& corner) { return a * corner.x + b * corner.y - c; };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner& from = polygon[i];
    const Corner& to = polygon[(i + 1) % polygon.size()];
    const double here = excess(from);
    const double there = excess(to);
    if (here <= 0.0) inside.push_back(from);
    if ((here < 0.0 && there > 0.0) || (here > 0.0 && there < 0.0)) {
      const double t = here / (here - there);
      inside.push_back({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)});
    }
  }
  return inside;
}

double area(const Polygon& polygon) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner& one = polygon[i];
    const Corner& next = polygon[(i + 1) % polygon.size()];
    sum += one.x * next.y - next.x * one.y;
  }
  return 0.5 * std::abs(sum);
}

}  // namespace nacre::independent
