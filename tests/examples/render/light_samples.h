#pragma once

#include <random>
#include <vector>

#include "examples/render/light_bounds.h"

/// \file
/// Lights of all kinds anywhere, and what they send somewhere by their own formulas.
namespace nacre::host {

class RandomLights {
 public:
  explicit RandomLights(std::uint32_t seed) : random_(seed) {}

  float number(float low, float high) {
    return low + (high - low) * std::uniform_real_distribution<float>()(random_);
  }
  Vec3 point(float size) { return {number(-size, size), number(-size, size), number(-size, size)}; }
  Vec3 direction() {
    while (true) {
      const Vec3 v = point(1.f);
      if (dot(v, v) > 0.01f && dot(v, v) < 1.f) return normalize(v);
    }
  }
  /// On a surface, or within.
  LitPlace place(float size) {
    const Vec3 P = point(size);
    return {P, number(0.f, 1.f) < 0.3f ? Vec3{} : direction()};
  }

 private:
  std::mt19937 random_;
};

/// A triangle that emits on one side or on both, a spot, or a point.
struct TestLight {
  Vec3 corners[3];
  Vec3 axis;
  float cos_o = -1.f, cos_e = -1.f;
  float intensity = 1.f, reach = INFINITY;
  bool both_ways = false;

  bool is_triangle() const { return cos_e == 0.f; }

  LightBounds bounds() const {
    LightBounds b;
    for (const Vec3 p : corners) b.box.add(p);
    b.intensity = double{intensity};
    b.cone = DirectionCone::about(axis, cos_o);
    b.cos_e = cos_e;
    b.reach = reach;
    b.both_ways = both_ways;
    return b;
  }

  /// Intensity over squares towards a place from one of its points; 0 outside of where it shines.
  double from(Vec3 corner, Vec3 place) const {
    const Vec3 way = place - corner;
    const double squared = double{dot(way, way)};
    if (squared > double{reach} * double{reach}) return 0.0;
    double cosine = double{dot(axis, way)} / std::sqrt(squared);
    if (both_ways) cosine = std::abs(cosine);
    if (cos_o > -1.f && cosine <= double{cos_e}) return 0.0;
    return double{intensity} / squared * (is_triangle() ? cosine : 1.0);
  }
};

inline TestLight random_light(RandomLights& random, float size) {
  TestLight light;
  const Vec3 at = random.point(size);
  for (Vec3& p : light.corners) p = at;
  light.intensity = std::exp(random.number(-3.f, 3.f));
  light.axis = random.direction();
  const float kind = random.number(0.f, 3.f);
  if (kind < 1.f) {
    for (Vec3& p : light.corners) p += random.point(0.02f * size);
    light.axis =
        normalize(cross(light.corners[1] - light.corners[0], light.corners[2] - light.corners[0]));
    light.cos_o = 1.f;
    light.cos_e = 0.f;
    light.both_ways = random.number(0.f, 1.f) < 0.4f;
  } else if (kind < 2.f) {
    light.cos_o = 1.f;
    light.cos_e = std::cos(random.number(0.05f, 1.5f));
  }
  if (random.number(0.f, 1.f) < 0.2f) light.reach = random.number(0.1f, 2.f) * size;
  return light;
}

}  // namespace nacre::host
