#include "examples/render/medium_lanes.h"

#include <algorithm>
#include <cmath>

#include "examples/render/batch_buffer.h"

namespace nacre::host {

namespace {

/// Nothing where it is no number; and no more than products of it can be numbers.
float amount(float x) { return x > 0.f ? std::min(x, 1e30f) : 0.f; }
Vec3 amount(Vec3 v) { return {amount(v.x), amount(v.y), amount(v.z)}; }

}  // namespace

Medium medium_of(const InteriorLanes& lanes, std::size_t lane) {
  const float g = lanes.anisotropy[lane];
  return {amount(load(lanes.absorption, lane)), amount(load(lanes.scattering, lane)),
          std::isfinite(g) ? std::clamp(g, -0.999f, 0.999f) : 0.f};
}

Medium medium_of(const VolumeLanes& lanes, std::size_t lane) {
  Medium medium = medium_of(lanes.medium, lane);
  medium.emission = amount(load(lanes.emission, lane));
  medium.is_open = true;
  return medium;
}

Dielectric dielectric_of(const InteriorLanes& lanes, std::size_t lane, int priority) {
  const float index = lanes.index[lane];
  return {std::isfinite(index) && index > 0.f ? index : 1.f, priority};
}

}  // namespace nacre::host
