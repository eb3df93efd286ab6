#pragma once

#include "examples/render/shader.h"

namespace nacre::host {

/// The inside of a surface, for light that has gone below it (sample_subsurface): all of it leaves,
/// in all directions of the outside by their cosine to the normal that the surface says.
class ExitShader final : public Shader {
 public:
  /// `surface`: may scatter light below, and lives as long.
  explicit ExitShader(const Shader& surface) : surface_(surface) {}

  Capabilities capabilities() const override;
  std::size_t state_bytes(std::uint32_t capacity) const override;
  void begin(const ShadingBatch& batch, void* state) const override;
  void sample(const ShadingBatch& batch, const void* state, Lanes3 u,
              SampleLanes out) const override;
  void evaluate(const ShadingBatch& batch, const void* state, Lanes3 wi,
                EvaluateLanes out) const override;
  void emission(const ShadingBatch&, Lanes3) const override {}
  void opacity(const ShadingBatch&, Lanes3) const override {}

 private:
  const Shader& surface_;
};

}  // namespace nacre::host
