#include "examples/render/light_bounds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nacre::host {

namespace {

constexpr double pi = std::numbers::pi;

/// Cosine and sine.
struct Angle {
  double cosine, sine;
};

/// a - b, but 0 where b is larger. Both within [0, pi].
Angle difference_or_0(Angle a, Angle b) {
  if (a.cosine >= b.cosine) return {1.0, 0.0};
  return {a.cosine * b.cosine + a.sine * b.sine, a.sine * b.cosine - a.cosine * b.sine};
}

double dot_exact(Vec3 a, Vec3 b) {
  return double{a.x} * double{b.x} + double{a.y} * double{b.y} + double{a.z} * double{b.z};
}

/// Between two directions that are about unit, with digits everywhere.
Angle angle_between(Vec3 a, Vec3 b) {
  const double x = double{a.y} * double{b.z} - double{a.z} * double{b.y};
  const double y = double{a.z} * double{b.x} - double{a.x} * double{b.z};
  const double z = double{a.x} * double{b.y} - double{a.y} * double{b.x};
  return {dot_exact(a, b), std::sqrt(x * x + y * y + z * z)};
}

double radians(Angle a) { return std::atan2(a.sine, a.cosine); }
Angle opening(const DirectionCone& cone) { return {double{cone.cos_o}, double{cone.sin_o}}; }
double theta_o(const DirectionCone& cone) { return radians(opening(cone)); }

/// A point in double, for squares of large coordinates.
struct Vector {
  double x, y, z;
};
double square(const Vector& v) { return v.x * v.x + v.y * v.y + v.z * v.z; }

Vector between(Vec3 a, Vec3 b) {
  return {double{b.x} - double{a.x}, double{b.y} - double{a.y}, double{b.z} - double{a.z}};
}

/// Squared distance to the nearest point of a box.
double squared_distance(const Bounds& box, Vec3 p) {
  const auto outside = [](float low, float high, float v) {
    return std::max(std::max(double{low} - double{v}, double{v} - double{high}), 0.0);
  };
  return square({outside(box.low.x, box.high.x, p.x), outside(box.low.y, box.high.y, p.y),
                 outside(box.low.z, box.high.z, p.z)});
}

Vec3 unit(const Vector& v) {
  const double scale = 1.0 / std::sqrt(square(v));
  return {static_cast<float>(scale * v.x), static_cast<float>(scale * v.y),
          static_cast<float>(scale * v.z)};
}

/// What is uncertain of an axis, in radians.
constexpr double rounding = 4e-6;

/// From `from` towards `to`, by that angle.
Vec3 turned(Vec3 from, Vec3 to, double angle) {
  const double along = dot_exact(from, to) / dot_exact(from, from);
  const Vector across = {double{to.x} - along * double{from.x},
                         double{to.y} - along * double{from.y},
                         double{to.z} - along * double{from.z}};
  // The same axis, or the opposite one: all ways are as good.
  const Vec3 other = square(across) > 1e-12 ? unit(across) : perpendicular(from);
  const double c = std::cos(angle), s = std::sin(angle);
  return unit({c * double{from.x} + s * double{other.x}, c * double{from.y} + s * double{other.y},
               c * double{from.z} + s * double{other.z}});
}

}  // namespace

DirectionCone DirectionCone::about(Vec3 axis, float cosine) {
  return {axis, cosine, std::sqrt(std::max(0.f, (1.f - cosine) * (1.f + cosine)))};
}

// Algorithm 1 of the paper. The axis is rounded, so the angle has some of that more.
DirectionCone united(const DirectionCone& a, const DirectionCone& b) {
  if (a.is_all()) return a;
  if (theta_o(a) < theta_o(b)) return united(b, a);
  const double between = radians(angle_between(a.axis, b.axis));
  const double wide = theta_o(a), narrow = theta_o(b);
  if (std::min(between + narrow, pi) <= wide) return a;
  const double both = 0.5 * (wide + between + narrow) + rounding;
  if (both >= pi) return DirectionCone::all();
  return {turned(a.axis, b.axis, both - rounding - wide), static_cast<float>(std::cos(both)),
          static_cast<float>(std::sin(both))};
}

LightBounds united(const LightBounds& a, const LightBounds& b) {
  if (a.is_dark()) return b;
  if (b.is_dark()) return a;
  // Of what shines both ways either axis will do.
  DirectionCone other = b.cone;
  if ((a.both_ways || b.both_ways) && dot(a.cone.axis, other.axis) < 0.f) other.axis = -other.axis;
  LightBounds both = {.box = a.box,
                      .intensity = a.intensity + b.intensity,
                      .cone = united(a.cone, other),
                      .cos_e = std::min(a.cos_e, b.cos_e),
                      .both_ways = a.both_ways || b.both_ways,
                      .reach = std::max(a.reach, b.reach)};
  both.box.add(b.box.low);
  both.box.add(b.box.high);
  return both;
}

double orientation_measure(const LightBounds& bounds) {
  const Angle cone = opening(bounds.cone);
  const double o = radians(cone);
  const double w = std::min(o + std::acos(std::clamp(double{bounds.cos_e}, -1.0, 1.0)), pi);
  const double one_way = 2 * pi * (1 - cone.cosine) +
                         pi / 2 * (2 * (w - o) * cone.sine - std::cos(o - 2 * w) + cone.cosine);
  return bounds.both_ways ? std::min(2 * one_way, 4 * pi) : one_way;
}

double importance(const LightBounds& bounds, const LitPlace& at) {
  if (bounds.is_dark()) return 0.0;
  if (std::isfinite(bounds.reach)) {
    const double reach = 1.00001 * double{bounds.reach};
    if (squared_distance(bounds.box, at.P) > reach * reach) return 0.0;
  }
  const Bounds& box = bounds.box;
  const Vector half = {0.5 * (double{box.high.x} - double{box.low.x}),
                       0.5 * (double{box.high.y} - double{box.low.y}),
                       0.5 * (double{box.high.z} - double{box.low.z})};
  const Vector low = between(at.P, box.low);
  const Vector way = {low.x + half.x, low.y + half.y, low.z + half.z};
  const double squared = square(way), radius = square(half);
  // A light that the place is on: nobody knows its direction.
  constexpr double smallest = 1e-30;
  const double nearest = std::max({squared, radius, smallest});
  const double fallen = bounds.intensity / nearest;
  if (!(squared > radius)) return fallen;
  const Vec3 to_light = unit(way);
  // What of the sky the box fills, by the sphere around it.
  const Angle uncertain = {std::sqrt(std::max(0.0, 1.0 - radius / squared)),
                           std::sqrt(radius / squared)};
  double emitted = 1.0;
  if (!bounds.cone.is_all()) {
    Angle from_axis = angle_between(bounds.cone.axis, -to_light);
    if (bounds.both_ways) from_axis.cosine = std::abs(from_axis.cosine);
    const Angle off_axis =
        difference_or_0(difference_or_0(from_axis, opening(bounds.cone)), uncertain);
    constexpr double tolerance = 1e-4;
    if (off_axis.cosine < double{bounds.cos_e} - tolerance) return 0.0;
    constexpr double least = 0.01;
    emitted = std::max(off_axis.cosine, least);
  }
  double received = 1.0;
  if (!is_zero(at.normal)) {
    Angle tilt = angle_between(at.normal, to_light);
    tilt.cosine = std::abs(tilt.cosine);
    constexpr double least = 0.05;
    received = std::max(difference_or_0(tilt, uncertain).cosine, least);
  }
  return fallen * emitted * received;
}

}  // namespace nacre::host
