#pragma once

#include <cstdint>
#include <limits>

#include "examples/render/bvh.h"
#include "examples/render/vec.h"

namespace nacre::host {

struct TransportSettings {
  int rays = 256;  ///< From each point, to each side.
  /// What is as far or farther is not met.
  float distance = std::numeric_limits<float>::infinity();
};

/// A point that rays start at.
struct TransportPoint {
  Vec3 P, N, Ng;           ///< World; N and Ng unit, on the same side.
  std::uint32_t seed = 0;  ///< Points that differ in it have other rays.
};

/// How open a point is to what is around.
struct Openness {
  /// The share of directions that meet nothing, weighted by their cosine with N, of those above the
  /// surface: 1 where nothing is near (Langer and Bülthoff 2000; Landis 2002, "Production-Ready
  /// Global Illumination", where the share that is met is meant by it).
  float ambient = 1.f;
  /// Their mean direction, unit; N where everything is met.
  Vec3 bent;
};

/// By rays of an Owen-scrambled sequence (sampler.h), distributed as the cosine with N.
Openness openness(const Bvh& scene, const TransportPoint& point, const TransportSettings& settings);

/// How far it is through what is below a point: the mean length of rays, distributed as the cosine
/// with -N, to what they meet first, of those below the surface. What meets nothing counts as
/// `settings.distance`, or not at all where that is infinite; 0 where none counts. 4r/3 in a
/// sphere of radius r, 2d in a wide plate of thickness d.
float thickness(const Bvh& scene, const TransportPoint& point, const TransportSettings& settings);

}  // namespace nacre::host
