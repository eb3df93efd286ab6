#pragma once

#include <cstdint>
#include <vector>

#include "examples/render/sampler.h"
#include "examples/render/scene.h"
#include "examples/render/shader.h"

namespace nacre::host {

/// The same radiance everywhere, from the front or from both sides; scatters nothing.
class ConstantEmitter final : public Shader {
 public:
  ConstantEmitter(Vec3 radiance, bool two_sided) : radiance_(radiance), two_sided_(two_sided) {}

  Capabilities capabilities() const override;
  std::size_t state_bytes(std::uint32_t) const override { return 0; }
  void begin(const ShadingBatch&, void*) const override {}
  void sample(const ShadingBatch&, const void*, Lanes3, SampleLanes) const override {}
  void evaluate(const ShadingBatch&, const void*, Lanes3, EvaluateLanes) const override {}
  void emission(const ShadingBatch& batch, Lanes3 radiance) const override;
  void opacity(const ShadingBatch&, Lanes3) const override {}

 private:
  Vec3 radiance_;
  bool two_sided_;
};

/// All emitting triangles of a scene, drawn in proportion to area times an
/// estimate of their luminance, and evenly over each.
class AreaLights {
 public:
  struct Sample {
    std::uint32_t mesh, triangle;
    float u, v;      ///< Barycentric, as Hit.
    float area_pdf;  ///< Per area over all lights.
  };

  /// Adds a mesh; `luminance` is per triangle. Unusable values count as 0.
  void add(const Scene& scene, std::uint32_t mesh, const std::vector<float>& luminance);
  /// After the last add().
  void finish();

  bool empty() const { return total_ == 0.0; }

  /// `choice` picks the triangle, `position` the point on it.
  Sample sample(float choice, Uniform2 position) const;
  /// Density per area with which sample() finds points of this triangle.
  float area_pdf(std::uint32_t mesh, std::uint32_t triangle) const;

 private:
  struct Entry {
    std::uint32_t mesh, triangle;
    float area, weight;
  };
  std::vector<Entry> entries_;
  std::vector<float> cdf_;                    ///< entries + 1
  std::vector<std::uint32_t> first_of_mesh_;  ///< ~0: the mesh does not emit.
  double total_ = 0;
};

}  // namespace nacre::host
