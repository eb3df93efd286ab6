#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/program/program.h"

namespace nacre {

/// Points of a batch: a kernel's arrays stay in the L2 cache, most in L1.
inline constexpr std::size_t batch_points = 4096;

/// Points to run kernels at, the same in every run.
struct PointSet {
  std::size_t count = batch_points;
  /// Of other numbers: other points of the same kind.
  std::uint32_t number = 0;
  /// Of every size, length and direction, from 2^-11 to 2^-6 along and down to a 32nd of that
  /// across, as surfaces that slant have them. Else a square of 2^-10 at all points, for
  /// benchmarks.
  bool varied_footprints = false;
};

/// What a channel holds there: positions in [-4, 4]^3, orthonormal frames around z, viewer and
/// light above the surface, texture coordinates in [0, 1]^2, other numbers in [0.05, 0.95].
std::vector<float> shading_points(const Channel& channel, const PointSet& points);

}  // namespace nacre
