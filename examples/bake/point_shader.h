#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "examples/bake/bake.h"
#include "examples/bake/surface.h"

namespace nacre::host {

/// Runs the kernel of an output at points of the surface that is baked: one for each thread, which
/// keeps its arrays from run to run.
class PointShader {
 public:
  PointShader(const OutputKernel& kernel, std::size_t output, const BakeSettings& settings);

  int width() const { return width_; }
  int height() const { return height_; }
  int components() const { return component_count(output_.type); }
  /// Whether results depend on the footprints of points: images are filtered, say.
  bool reads_footprints() const;
  /// What one run should get: enough points to be worth it, few enough that it soon sees that
  /// there is compiled code, or that it is to stop.
  std::size_t points_of_a_run() const;

  /// See SurfacePoints.
  /// @{
  void enter(int first, int rows) { surface_->enter(first, rows); }
  bool covers(std::size_t texel) const { return surface_->covers(texel); }
  /// @}

  RunStatus run(const TexelPoints& points, const std::atomic<std::uint32_t>& stop);
  /// Of the last run that was done: a component of each point, booleans and integers as floats.
  const std::vector<float>& result(std::size_t component) const { return results_[component]; }
  /// Whether a point of it was on the surface, and not beside it.
  bool counts(std::size_t point) const { return on_surface_.empty() || on_surface_[point] != 0; }

 private:
  /// An input of the kernel, and what it was filled for.
  struct Input {
    std::vector<float> values;
    bool is_constant = false;
    float footprint = 0.0f;
  };

  void set(std::string_view name, float value);
  void fill(const TexelPoints& points);

  const OutputKernel& kernel_;
  const OutputKernel::Output& output_;
  int width_, height_;
  bool in_frame_;
  std::unique_ptr<SurfacePoints> surface_;
  std::span<const std::uint8_t> on_surface_;
  std::vector<std::uint32_t> parameters_;
  std::vector<Input> inputs_;
  std::vector<const void*> in_;
  std::vector<std::vector<float>> outputs_;  ///< Those of other outputs of the kernel.
  std::vector<std::vector<float>> results_;
};

}  // namespace nacre::host
