#pragma once

#include <functional>
#include <stop_token>
#include <vector>

#include "jit/shading/shading_system.h"

namespace nacre::host {

struct BakeSettings {
  int width = 1024, height = 1024;
  int corner_u = 0, corner_v = 0;  ///< uv of the image's lower left: the tile of a set.
  int threads = 0;                 ///< 0: as many as the machine has.
  float frame = 1.0f;
  float time = 0.0f;
  /// Bytes for the rows being computed; the image itself is the sink's business.
  std::size_t memory = std::size_t{64} << 20;
};

/// Texels of whole rows of one output, interleaved, booleans and integers as
/// floats: (rows * width * components) of them.
struct BakedRows {
  int first = 0;
  int rows = 0;
  std::vector<float> texels;
};

struct BakeControl {
  std::stop_token stop;
  /// The finished share, 0 to 1; called by the thread that called bake().
  std::function<void(double)> progress;
};

/// How a bake ended.
enum class BakeResult {
  done,
  stopped,         ///< By BakeControl::stop.
  refused,         ///< The sink returned false.
  too_many_steps,  ///< The kernel did: RunStatus.
};

/// Shades the plane with one output of a kernel and hands over the rows from top
/// to bottom. The texels do not depend on threads or memory.
BakeResult bake(const OutputKernel& kernel, std::size_t output, const BakeSettings& settings,
                const std::function<bool(const BakedRows&)>& sink, const BakeControl& control = {});

/// The error that BakeResult::too_many_steps is.
void report_too_many_steps(const OutputKernel::Output& output, Diagnostics& diagnostics);

/// A whole output in memory; empty if the kernel takes too many steps.
std::vector<float> bake_image(const OutputKernel& kernel, std::size_t output,
                              const BakeSettings& settings);

}  // namespace nacre::host
