#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "examples/render/shader.h"
#include "jit/shading/shading_system.h"

namespace nacre::tool {

/// The kernels of a material behind the render host's interface: binds the
/// host's lanes to the kernels' channels by name, once.
class KernelShader final : public host::Shader {
 public:
  explicit KernelShader(std::unique_ptr<MaterialKernels> kernels);

  host::Capabilities capabilities() const override { return capabilities_; }
  /// Whether any kernel reads the first uv set.
  bool reads_uv() const { return reads_uv_; }
  std::size_t state_bytes(std::uint32_t capacity) const override;
  void begin(const host::ShadingBatch& batch, void* state) const override;
  void sample(const host::ShadingBatch& batch, const void* state, host::Lanes3 u,
              host::SampleLanes out) const override;
  void evaluate(const host::ShadingBatch& batch, const void* state, host::Lanes3 wi,
                host::EvaluateLanes out) const override;
  void emission(const host::ShadingBatch& batch, host::Lanes3 radiance) const override;
  void opacity(const host::ShadingBatch& batch, host::Lanes3 rgb) const override;

 private:
  /// Where one input channel of a kernel is found in a batch.
  struct Bound {
    BoundKernel* kernel = nullptr;
    std::vector<std::function<const float*(const host::ShadingBatch&)>> from_batch;
    std::vector<int> extra;                  ///< By input: index into the call's own arrays, or -1.
    std::vector<int> state;                  ///< By input: index of the state channel, or -1.
    std::optional<std::size_t> frame, time;  ///< Slots of the parameter block.
    /// Slots that say whether the mesh has a geometric property, and its primvar.
    std::vector<std::pair<std::size_t, int>> present;
  };

  void bind(std::optional<BoundKernel>& kernel, Bound& bound,
            const std::vector<std::string_view>& extras);
  int find_primvar(std::string_view name, int components);
  void run(const Bound& bound, const host::ShadingBatch& batch, const void* state,
           std::span<const float* const> extras, std::span<void* const> outputs) const;
  static std::vector<std::uint32_t> parameters(const Bound& bound, const host::ShadingBatch& batch);
  static std::uint32_t stride(std::uint32_t count);

  std::unique_ptr<MaterialKernels> kernels_;
  host::Capabilities capabilities_;
  bool reads_uv_ = false;
  Bound begin_, sample_, evaluate_, emission_, opacity_;
};

}  // namespace nacre::tool
