#pragma once

#include <cstdint>

namespace nacre::host {

/// What a render did: it adds up over threads, and over the runs that go on from a checkpoint.
struct RenderCounts {
  std::uint64_t paths = 0;
  std::uint64_t rays = 0;  ///< Camera and scattered.
  std::uint64_t shadow_rays = 0;
  /// Kernel results that were not finite, and were dropped. Not 0: a bug in a shader.
  std::uint64_t invalid_results = 0;
  std::uint64_t beyond_bound = 0;   ///< Points of volumes that are denser than was found before.
  std::uint64_t media_dropped = 0;  ///< Of paths that were inside of more than Media holds.
  std::uint64_t paths_cut = 0;  ///< That were scattered more often in media than max_scatterings.
  /// Seconds, summed over threads, within Shader calls and within Embree.
  double shading_seconds = 0, tracing_seconds = 0;

  void add(const RenderCounts& other);
};

}  // namespace nacre::host
