#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "examples/render/batch_channels.h"
#include "jit/tune/recorded_points.h"
#include "runtime/program/program.h"

namespace nacre::tool {

/// Keeps some of the points that are shaded: those whose numbers have the least hashes, so that
/// which they are depends neither on threads nor on an order, and each is there once.
class PointRecorder {
 public:
  static constexpr std::size_t most = 4096;

  /// A channel to keep, where a batch has it; the same one may be wanted again.
  void want(const Channel& channel, host::BatchSource source);
  /// By any thread. What is not finite everywhere is left out.
  void add(const host::ShadingBatch& batch);

  PointsOfMaterial points(const std::string& material) const;

 private:
  struct Wanted {
    Channel channel;
    host::BatchSource source;
  };

  std::vector<Wanted> wanted_;
  mutable std::mutex mutex_;
  std::map<std::uint64_t, std::vector<std::uint32_t>> kept_;  ///< By hash: bits of all wanted.
};

/// Of one material that several shaders were made for: the points of all of them, with the channels
/// that all of them read.
PointsOfMaterial joined(std::vector<PointsOfMaterial> points);

}  // namespace nacre::tool
