#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "examples/bake/bake.h"
#include "examples/bake/point_shader.h"
#include "examples/bake/sample_set.h"

namespace nacre::host {

/// Texels of rows with the same number of samples in each.
class TexelSampler {
 public:
  /// `count` samples at a texel; see sample_places.
  TexelSampler(PointShader& shader, int count);

  /// Rows [first, first + rows), into as many planes as there are components.
  RunStatus rows(int first, int rows, std::vector<std::vector<float>>& planes,
                 const std::atomic<std::uint32_t>& stop);

  std::size_t count() const { return places_.size(); }

 private:
  RunStatus strip(int first, int rows, std::vector<std::vector<float>>& planes, std::size_t at,
                  const std::atomic<std::uint32_t>& stop);

  PointShader& shader_;
  std::vector<SamplePlace> places_;
  TexelPoints points_;
  std::vector<std::vector<double>> sums_;
};

}  // namespace nacre::host
