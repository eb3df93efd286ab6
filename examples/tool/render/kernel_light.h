#pragma once

#include <memory>

#include "examples/render/light_shader.h"
#include "examples/tool/render/kernel_shader.h"

namespace nacre::tool {

/// Whether a light stands somewhere by itself; else it is of a mesh.
bool has_place(const Program& light);

/// A light shader of a document that a point sees: point, spot, directional.
class KernelLight final : public host::LightShader {
 public:
  /// Null, with an error at the node, where the light reads more of a point than where it is. The
  /// kernel has a place.
  static std::unique_ptr<KernelLight> create(std::unique_ptr<OutputKernel> kernel, RenderStop& stop,
                                             Diagnostics& diagnostics);
  void light(const host::ShadingBatch& batch, host::LightLanes out) const override;
  /// Whether its kernel took too many steps.
  bool has_failed() const { return failed_; }
  const OutputKernel& kernel() const { return *kernel_; }

 private:
  KernelLight(std::unique_ptr<OutputKernel> kernel, RenderStop& stop);

  std::unique_ptr<OutputKernel> kernel_;
  RenderStop& stop_;
  /// Where its channels are found, in their order.
  std::vector<std::function<const void*(const host::ShadingBatch&)>> inputs_;
  std::vector<std::function<void*(const host::LightLanes&)>> outputs_;
  std::optional<std::size_t> time_, frame_;  ///< Slots of the parameter block.
  mutable std::atomic<bool> failed_ = false;
};

}  // namespace nacre::tool
