#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

#include "examples/render/passes.h"
#include "examples/render/shader.h"
#include "examples/tool/render/displacement_box.h"
#include "examples/tool/render/lobe_parts.h"
#include "examples/tool/render/point_recorder.h"
#include "jit/shading/shading_system.h"

namespace nacre::tool {

/// Ends a render from outside and from within its kernels: one that takes too many steps
/// has no result, and then the image has none.
class RenderStop {
 public:
  RenderStop() = default;
  RenderStop(const RenderStop&) = delete;
  RenderStop& operator=(const RenderStop&) = delete;

  /// Also when a stop is requested of the token's source.
  void follow(std::stop_token asked) {
    asked_.emplace(std::move(asked), [this] { request(); });
  }

  void request() {
    flag_ = 1;
    source_.request_stop();
  }
  /// For the render,
  std::stop_token token() const { return source_.get_token(); }
  /// and for kernels: KernelArguments::stop.
  const std::atomic<std::uint32_t>& flag() const { return flag_; }

 private:
  std::stop_source source_;
  std::atomic<std::uint32_t> flag_ = 0;
  std::optional<std::stop_callback<std::function<void()>>> asked_;
};

/// Whether light that enters the material is in something.
bool has_medium(const MaterialKernels& kernels);

/// The kernels of a material behind the render host's interface: binds the
/// host's lanes to the kernels' channels by name, once.
class KernelShader final : public host::Shader {
 public:
  /// `stop` is asked for when a kernel fails, and ends kernels; it lives as long. `is_nested`:
  /// interior() is wanted of what is clear, too. `values`: of graphs, that begin() stores for
  /// point(). `records`: recorder() keeps points that are shaded.
  KernelShader(std::unique_ptr<MaterialKernels> kernels, RenderStop& stop, bool is_nested = false,
               const std::vector<host::GraphValue>& values = {}, bool records = false);

  /// Those that a render calls.
  std::vector<const BoundKernel*> kernels() const;
  /// Null where nothing is recorded.
  const PointRecorder* recorder() const { return recorder_.get(); }
  /// Whether a kernel took too many steps.
  bool has_failed() const { return failed_; }

  host::Capabilities capabilities() const override { return capabilities_; }
  /// Whether light enters: whether there could be an interior().
  bool lets_in() const { return kernels_->interior.has_value(); }
  /// Whether any kernel reads the first uv set.
  bool reads_uv() const { return reads_uv_; }
  std::size_t state_bytes(std::uint32_t capacity) const override;
  void begin(const host::ShadingBatch& batch, void* state) const override;
  void point(const host::ShadingBatch& batch, const void* state,
             const host::PointLanes& out) const override;
  void sample(const host::ShadingBatch& batch, const void* state, host::Lanes3 u,
              host::SampleLanes out) const override;
  void evaluate(const host::ShadingBatch& batch, const void* state, host::Lanes3 wi,
                host::EvaluateLanes out) const override;
  void emission(const host::ShadingBatch& batch, host::Lanes3 radiance) const override;
  void opacity(const host::ShadingBatch& batch, host::Lanes3 rgb) const override;
  void interior(const host::ShadingBatch& batch, host::InteriorLanes out) const override;
  void volume(const host::ShadingBatch& batch, host::VolumeLanes out) const override;
  void displacement(const host::ShadingBatch& batch, host::Lanes3 offset) const override;
  host::Bounds displacement_box(const host::ShadingBatch& corners) const override {
    return tool::displacement_box(*kernels_->recorded_displacement, corners);
  }
  void subsurface(const host::ShadingBatch& batch, const std::int32_t* lobe,
                  host::SubsurfaceLanes out) const override;

 private:
  /// Where one input channel of a kernel is found in a batch.
  struct Bound {
    BoundKernel* kernel = nullptr;
    std::vector<std::function<const void*(const host::ShadingBatch&)>> from_batch;
    std::vector<int> extra;                  ///< By input: index into the call's own arrays, or -1.
    std::vector<int> state;                  ///< By input: index of the state channel, or -1.
    std::optional<std::size_t> frame, time;  ///< Slots of the parameter block.
    /// Slots that say whether the meshes have a geometric property, and its primvar.
    std::vector<std::pair<std::size_t, int>> present;
  };

  void bind(std::optional<BoundKernel>& kernel, Bound& bound,
            const std::vector<std::string_view>& extras);
  void run(const Bound& bound, const host::ShadingBatch& batch, const void* state,
           std::span<const void* const> extras, std::span<void* const> outputs) const;
  std::vector<float> run_by_lobe(const Bound& bound, const LobeParts& parts,
                                 const host::ShadingBatch& batch, const void* state,
                                 std::span<const void* const> extras,
                                 std::span<void* const> outputs) const;
  void find_columns(const std::vector<host::GraphValue>& values);
  static std::vector<std::uint32_t> parameters(const Bound& bound, const host::ShadingBatch& batch);
  static std::uint32_t stride(std::uint32_t count);

  std::unique_ptr<MaterialKernels> kernels_;
  RenderStop& stop_;
  mutable std::atomic<bool> failed_ = false;
  std::unique_ptr<PointRecorder> recorder_;
  host::Capabilities capabilities_;
  bool reads_uv_ = false;
  LobeParts sample_parts_, evaluate_parts_;
  /// By output of begin(): which column of the state it goes to, those of the state first.
  std::vector<std::size_t> columns_;
  struct PointColumn {
    std::size_t column;
    bool is_whole;  ///< Integers or truths.
  };
  /// Of PointLanes: of albedo and normal, roughness, and values; not in the state: none.
  std::vector<std::optional<PointColumn>> point_columns_;
  Bound begin_, sample_, evaluate_, emission_, opacity_, interior_, displacement_, subsurface_,
      volume_;
};

}  // namespace nacre::tool
