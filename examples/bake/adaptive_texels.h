#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "examples/bake/bake.h"
#include "examples/bake/point_shader.h"
#include "examples/bake/sample_set.h"

namespace nacre::host {

/// Texels with as many samples as each needs: sets of 4, 16, 64, 256 and 1024 places
/// (sample_places) are shaded one after another, all samples of a texel count alike, and a texel
/// gets the next set while
///
/// * its error is above the one asked for. After the first set that is what its samples differ
///   from a plane by, one as steep as the neighbours say; after others half of what the set
///   changed the mean by, but at least a third of what it was before: so slowly the errors of edges
///   fall with four times the samples, and sets may agree by chance;
/// * or, after the first set, a neighbour's is;
/// * or its neighbours say that an edge may have passed by all samples: an edge as high as a second
///   difference of texels, d, is worth d / 2n of a texel where n samples do not see it; more than
///   four times the error asked for is looked into.
///
/// Samples beside the surface are no samples; see TexelSampler. What it gives does not depend on
/// the rows it is asked for together: a row above and below are looked at with the first set.
class AdaptiveTexels {
 public:
  static constexpr int most_samples = 4 + 16 + 64 + 256 + 1024;

  AdaptiveTexels(PointShader& shader, float error);

  /// Rows [first, first + rows), into as many planes as there are components.
  RunStatus rows(int first, int rows, std::vector<std::vector<float>>& planes,
                 const std::atomic<std::uint32_t>& stop, BakeCounts& counts);

 private:
  static constexpr std::size_t sets = 5;

  RunStatus first_set(int first, int rows, const std::atomic<std::uint32_t>& stop,
                      BakeCounts& counts);
  RunStatus next_set(std::size_t set, int first, const std::vector<std::size_t>& texels,
                     const std::atomic<std::uint32_t>& stop, BakeCounts& counts);
  /// What the neighbours' means say of the first set.
  void look_around();
  void compare_slopes(std::size_t component, std::size_t texel, float along, float across);
  bool wants_more(std::size_t texel, std::size_t set) const;
  /// Whether a texel or one of the eight around it is not exact enough.
  bool is_near_error(std::size_t texel) const;
  float spread(std::size_t first, std::size_t samples, std::size_t texel) const;
  float relative(float difference, std::size_t component, std::size_t texel) const;

  PointShader& shader_;
  float error_;
  std::size_t width_;
  std::array<std::vector<SamplePlace>, sets> places_;
  TexelPoints points_;
  std::vector<std::vector<float>> means_;  ///< By component; also of the rows around those asked.
  /// By component: by how much the samples on the right of the first set exceed those on the
  /// left, and those below those above.
  std::vector<std::vector<float>> along_, across_;
  std::vector<std::uint8_t> covered_;  ///< Texels that have some of the surface.
  std::vector<std::uint32_t> hits_;    ///< Samples of each that count.
  std::vector<float> errors_;
  std::vector<float> edges_;  ///< The highest edge that may be in a texel.
};

}  // namespace nacre::host
