#include "examples/bake_mesh/flat_triangle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace nacre::host {

namespace {

/// Twice the area of a, b and p, positive where p is to the left of the way from a to b. The other
/// way round the result is the same but for its sign.
double edge(FlatPlace a, FlatPlace b, FlatPlace p) {
  const bool is_turned = b.x < a.x || (b.x == a.x && b.y < a.y);
  if (is_turned) std::swap(a, b);
  const double twice = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
  return is_turned ? -twice : twice;
}

}  // namespace

FlatTriangle::FlatTriangle(FlatPlace a, FlatPlace b, FlatPlace c)
    : v_{a, b, c},
      low_{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y})},
      high_{std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y})},
      twice_area_((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) {}

double FlatTriangle::area() const { return 0.5 * std::abs(twice_area_); }

/// Opposite to each corner, positive inside.
std::array<double, 3> FlatTriangle::edges(FlatPlace p) const {
  const double sign = twice_area_ < 0.0 ? -1.0 : 1.0;
  return {sign * edge(v_[1], v_[2], p), sign * edge(v_[2], v_[0], p), sign * edge(v_[0], v_[1], p)};
}

bool FlatTriangle::contains(FlatPlace p) const {
  const std::array<double, 3> e = edges(p);
  return e[0] >= 0.0 && e[1] >= 0.0 && e[2] >= 0.0;
}

bool FlatTriangle::contains_strictly(FlatPlace p) const {
  const std::array<double, 3> e = edges(p);
  return e[0] > 0.0 && e[1] > 0.0 && e[2] > 0.0;
}

FlatWeights FlatTriangle::weights(FlatPlace p) const {
  std::array<double, 3> e = edges(p);
  double sum = 0.0;
  for (double& each : e) sum += each = std::max(each, 0.0);
  return sum > 0.0 ? FlatWeights{e[1] / sum, e[2] / sum} : FlatWeights{1.0 / 3.0, 1.0 / 3.0};
}

FlatWeights FlatTriangle::next_to(FlatPlace p, double& squared) const {
  squared = std::numeric_limits<double>::infinity();
  FlatWeights best;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const FlatPlace a = v_[i], b = v_[j];
    const double dx = b.x - a.x, dy = b.y - a.y;
    const double along = ((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy);
    const double t = along > 0.0 ? std::min(along, 1.0) : 0.0;  // NaN is 0.
    const double x = a.x + t * dx - p.x, y = a.y + t * dy - p.y;
    const double distance = x * x + y * y;
    if (!(distance < squared)) continue;
    squared = distance;
    std::array<double, 3> weights{};
    weights[i] = 1.0 - t;
    weights[j] = t;
    best = {weights[1], weights[2]};
  }
  return best;
}

void FlatTriangle::derivatives(FlatWeights& along_x, FlatWeights& along_y) const {
  const double scale = 1.0 / twice_area_;
  along_x = {scale * (v_[2].y - v_[0].y), scale * (v_[0].y - v_[1].y)};
  along_y = {scale * (v_[0].x - v_[2].x), scale * (v_[1].x - v_[0].x)};
}

bool FlatTriangle::span(double low_y, double high_y, double& low_x, double& high_x) const {
  low_x = std::numeric_limits<double>::infinity();
  high_x = -low_x;
  const auto add = [&](double x) {
    low_x = std::min(low_x, x);
    high_x = std::max(high_x, x);
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const FlatPlace a = v_[i], b = v_[(i + 1) % 3];
    if (a.y >= low_y && a.y <= high_y) add(a.x);
    for (const double y : {low_y, high_y}) {
      const bool crosses = (a.y < y && b.y > y) || (a.y > y && b.y < y);
      if (!crosses) continue;
      const double x = a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
      add(std::clamp(x, std::min(a.x, b.x), std::max(a.x, b.x)));
    }
  }
  return low_x <= high_x;
}

}  // namespace nacre::host
