#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

#include "examples/bake/adaptive_texels.h"
#include "examples/bake/bake.h"
#include "examples/bake/point_shader.h"
#include "examples/bake/sample_set.h"

namespace nacre::host {

/// Texels with as many samples as each needs, for kernels that read footprints: images are
/// filtered over as much as samples lie apart, so that what few samples are off by is not chance
/// but blur (and what filtering before an operation that is not linear does).
///
/// Samples are the middles of 1, 2 x 2, 4 x 4, ... 32 x 32 squares. Where those lie on the texels
/// of an image's levels they are exact, which no other pattern is. A texel has the mean of the
/// finest squares that it was sampled by, and not of the coarser ones, whose blur is wider. Blurs
/// fall at least with the footprints, which are halved: so a mean is at most as far off as it is
/// from the one before, and at least a quarter of what that was: means may agree by chance. While
/// it is more than the error asked for, squares are halved again; at first also where it is more in
/// one of the eight texels around, or where an edge beside a flat texel may be in it unseen.
///
/// Which squares are the first is found by a look ahead: detail far below a texel is in no mean of
/// coarse squares, nor in their differences. Of up to 64 texels, spread over the image, all squares
/// are sampled, and the first are those with which seven of eight texels are exact enough.
///
/// Samples beside the surface are no samples; see TexelSampler. What it gives does not depend on
/// the rows it is asked for together.
class FilteredTexels {
 public:
  /// What the look ahead found, one for all threads of a bake.
  struct Start {
    std::mutex mutex;
    std::optional<int> level = {};
  };

  FilteredTexels(PointShader& shader, float error, Start& start);

  /// Rows [first, first + rows), into as many planes as there are components.
  RunStatus rows(int first, int rows, std::vector<std::vector<float>>& planes,
                 const std::atomic<std::uint32_t>& stop, BakeCounts& counts);

 private:
  static constexpr int finest = 5;  ///< Of 2^5 squares along a side.
  static_assert(1 << 2 * finest == AdaptiveTexels::most_samples);

  using Means = std::vector<std::vector<float>>;  ///< By component, of each texel.

  /// Finds the first level, unless another thread has.
  RunStatus find_start(const std::atomic<std::uint32_t>& stop, BakeCounts& counts);
  RunStatus look_ahead(const std::atomic<std::uint32_t>& stop, BakeCounts& counts);
  std::vector<std::size_t> covered_of_row(int row, std::size_t most);
  /// Means of texels counted from row `first` on, and by how much their samples differ.
  RunStatus sample(int level, int first, const std::vector<std::size_t>& texels, Means& means,
                   const std::atomic<std::uint32_t>& stop, BakeCounts& counts,
                   Means* spreads = nullptr);
  float unseen(std::size_t texel) const;
  float difference(const Means& a, const Means& b, std::size_t texel) const;

  PointShader& shader_;
  float error_;
  std::size_t width_;
  TexelPoints points_;
  std::vector<std::vector<SamplePlace>> places_;  ///< Of each level.
  Start& start_;
  std::optional<int> first_level_;  ///< That is start_'s.
  Means means_, before_;
  Means spreads_;                      ///< Of the first squares' samples.
  std::vector<std::uint8_t> covered_;  ///< Texels that have some of the surface.
  std::vector<float> errors_;
};

}  // namespace nacre::host
