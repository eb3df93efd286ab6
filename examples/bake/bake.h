#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "examples/bake/dilate.h"
#include "examples/bake/surface.h"
#include "jit/shading/shading_system.h"

namespace nacre::host {

/// How a texel becomes the mean of samples in it: a box filter of the texel's size. Image
/// look-ups and derivatives are of footprints as wide as samples lie apart.
struct Sampling {
  int count = 1;  ///< Of each texel; 0: as many as `error` asks for.
  /// Of a texel, in units of the output, of its own value where that is above 1: samples are
  /// added until the estimated error is as small. See adaptive_texels.h, and filtered_texels.h for
  /// what reads footprints.
  float error = 1.0f / 510.0f;
};

/// What of uv an image of the plane shows: from the lower left corner, so far to the right and up.
struct UvArea {
  float u = 0.0f, v = 0.0f;
  float width = 1.0f, height = 1.0f;
};

struct BakeSettings {
  int width = 1024, height = 1024;
  int corner_u = 0, corner_v = 0;  ///< uv of the image's lower left: the tile of a set.
  /// Of the plane, in place of the tile.
  std::optional<UvArea> window = {};
  int threads = 0;  ///< 0: as many as the machine has.
  float frame = 1.0f;
  float time = 0.0f;
  Sampling sampling = {};                ///< Of outputs of floats; others have one sample a texel.
  const BakeSurface* surface = nullptr;  ///< Null: the plane.
  Dilation dilation = {};                ///< Of what a surface leaves empty.
  /// Of vectors: as the surface's tangent, bitangent and normal have them, rather than the world.
  bool in_frame = false;
};

/// Texels of whole rows of one output, width * rows of each component, booleans and integers
/// as floats.
struct BakedRows {
  int first = 0;
  int rows = 0;
  std::vector<std::vector<float>> planes;
  /// Of each texel 1 where it has some of the surface; empty: all have.
  std::vector<std::uint8_t> covered;
};

/// What it took.
struct BakeCounts {
  std::uint64_t samples = 0;
  std::uint64_t unfinished = 0;  ///< Texels that had the most samples and wanted more.
  /// Of all threads' processor time: to make points and to run the kernel.
  double shading_seconds = 0.0;
};

struct BakeControl {
  std::stop_token stop;
  /// The finished share, 0 to 1; called by any thread, one at a time.
  std::function<void(double)> progress;
};

/// What an image of the plane shows: the window, or else the tile.
UvArea area_of(const BakeSettings& settings);

/// How a bake ended.
enum class BakeResult {
  done,
  stopped,         ///< By BakeControl::stop.
  refused,         ///< The sink returned false.
  too_many_steps,  ///< The kernel did: RunStatus.
};

/// Gets blocks of rows, in any order, on several threads at once, and may change them. What it
/// returns is called for one block after another, from top to bottom; false ends the bake.
using RowSink = std::function<std::function<bool()>(BakedRows&)>;

/// True for outputs that have a mean.
bool has_mean(Type type);

/// Shades the surface with one output of a kernel and hands over blocks of `block_rows` rows, the
/// last of which may have fewer. The texels do not depend on threads or blocks. Those that have
/// nothing of the surface are 0.
BakeResult bake(const OutputKernel& kernel, std::size_t output, const BakeSettings& settings,
                int block_rows, const RowSink& sink, const BakeControl& control = {},
                BakeCounts* counts = nullptr);

/// The error that BakeResult::too_many_steps is.
void report_too_many_steps(const OutputKernel::Output& output, Diagnostics& diagnostics);

/// A whole output in memory, components side by side; empty if the kernel takes too many steps.
std::vector<float> bake_image(const OutputKernel& kernel, std::size_t output,
                              const BakeSettings& settings);

}  // namespace nacre::host
