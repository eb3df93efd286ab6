#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "examples/bake/bake.h"
#include "examples/bake/point_shader.h"
#include "examples/bake/sample_set.h"

namespace nacre::host {

/// Texels with as many samples as each needs, for kernels that read no footprints (others:
/// FilteredTexels): 4, 8, 16 and so on up to 1024 places of a sequence (sample_sequence). A texel's
/// are doubled while
///
/// * its error is above the one asked for. After the first four that is what they differ from a
///   plane by, one as steep as the neighbours say; later it comes from the means of four quarters
///   of the samples, each of which is as evenly spread as all: the deviation of one of them from
///   the others, and less by what errors at edges fall by with four times the samples; twice the
///   gap between the older half and the newer where there is one, for that is a blur which falls
///   with the footprints; and at least a certain part of what it was before, since quarters may
///   agree by chance;
/// * or, after the first four, a neighbour's is;
/// * or its neighbours say that an edge may have passed by all samples: an edge as high as a second
///   difference of texels, d, is worth d / 2n of a texel where n samples do not see it; more than
///   four times the error asked for is looked into.
///
/// Samples beside the surface are no samples; see TexelSampler. What it gives does not depend on
/// the rows it is asked for together: a row above and below are looked at with the first four.
class AdaptiveTexels {
 public:
  static constexpr int most_samples = 1024;

  AdaptiveTexels(PointShader& shader, float error);

  /// Rows [first, first + rows), into as many planes as there are components.
  RunStatus rows(int first, int rows, std::vector<std::vector<float>>& planes,
                 const std::atomic<std::uint32_t>& stop, BakeCounts& counts);

 private:
  RunStatus first_set(int first, int rows, const std::atomic<std::uint32_t>& stop,
                      BakeCounts& counts);
  /// Adds samples up to as many a texel, for texels that have half of them, or none and it is four.
  RunStatus add_samples(std::size_t total, int first, const std::vector<std::size_t>& texels,
                        const std::atomic<std::uint32_t>& stop, BakeCounts& counts);
  void add_result(std::size_t texel, std::size_t begin, std::size_t count, bool is_first);
  float error_of_four(std::size_t component, std::size_t texel, std::size_t begin);
  float error_of_quarters(std::size_t component, std::size_t texel,
                          const std::array<float, 2>& added);
  /// What the neighbours' means say of the first four.
  void look_around();
  void compare_slopes(std::size_t component, std::size_t texel, float along, float across);
  bool wants_more(std::size_t texel, std::size_t total) const;
  float spread(std::size_t first, std::size_t samples, std::size_t texel) const;
  float relative(float difference, std::size_t component, std::size_t texel) const;

  PointShader& shader_;
  float error_;
  std::size_t width_;
  std::vector<SamplePlace> places_;
  TexelPoints points_;
  std::vector<std::vector<float>> means_;  ///< By component; also of the rows around those asked.
  std::vector<std::vector<float>> first_half_, second_half_;  ///< Means of so many of the samples.
  /// By component: by how much the samples on the right of the first four exceed those on the
  /// left, and those below those above.
  std::vector<std::vector<float>> along_, across_;
  SamplePlace along_step_, across_step_;  ///< The same of the places.
  std::array<float, 4> off_plane_{};      ///< Factors of the first four, 0 together for a plane.
  std::vector<std::uint8_t> covered_;     ///< Texels that have some of the surface.
  std::vector<std::uint32_t> hits_;       ///< Samples of each that count.
  std::vector<float> errors_;
  std::vector<float> edges_;  ///< The highest edge that may be in a texel.
};

}  // namespace nacre::host
