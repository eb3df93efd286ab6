#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "examples/bake/bake.h"
#include "examples/bake/point_shader.h"
#include "examples/bake/sample_set.h"

namespace nacre::host {

/// Texels of rows with the same number of samples in each, of which those on the surface count;
/// where none is, the surface's point next to the middle stands for the texel.
class TexelSampler {
 public:
  /// `count` samples at a texel; see sample_places.
  TexelSampler(PointShader& shader, int count);

  /// Rows [first, first + rows), into as many planes as there are components. Texels without any
  /// surface are 0.
  RunStatus rows(int first, int rows, std::vector<std::vector<float>>& planes,
                 const std::atomic<std::uint32_t>& stop, BakeCounts& counts);

 private:
  /// Texels from `begin`, of `texels_`, which are `count`; planes begin at row `first`.
  RunStatus strip(std::size_t begin, std::size_t count, std::size_t first,
                  std::vector<std::vector<float>>& planes, const std::atomic<std::uint32_t>& stop);
  void list_texels(std::size_t begin, std::size_t all);
  void add_samples(std::size_t count);

  PointShader& shader_;
  std::vector<SamplePlace> places_;
  TexelPoints points_;
  std::vector<std::size_t> texels_;    ///< That the surface covers, row * width + column.
  std::vector<float> columns_, rows_;  ///< Of them.
  std::vector<std::vector<double>> sums_;
  std::vector<std::vector<float>> beside_;  ///< What stands for texels without samples.
  std::vector<std::uint32_t> hits_;         ///< Samples that count.
};

}  // namespace nacre::host
