#pragma once

#include <cstddef>
#include <cstdint>

#include "examples/render/sampler.h"
#include "examples/render/shader.h"
#include "examples/render/vec.h"

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

/// A point even over a triangle, barycentric as Hit's.
Vec2 sample_triangle(Uniform2 u);

}  // namespace nacre::host
