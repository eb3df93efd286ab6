#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "jit/passes/range.h"
#include "runtime/batch/binder.h"
#include "runtime/batch/layout.h"
#include "runtime/diagnostic.h"
#include "runtime/kernel.h"
#include "runtime/texture/file_identity.h"
#include "runtime/texture/texture.h"

namespace nacre {

struct BoundCode;
class CompiledKernel;
class LastFitted;
class ParameterFits;
class RecordedTextures;

/// A kernel with its textures and the parameter values of its document. Shared
/// by any number of threads; holds what it needs alive.
class BoundKernel {
 public:
  /// `textures` may be null for a Program that reads none.
  BoundKernel(std::shared_ptr<const Kernel> kernel,
              std::shared_ptr<const RecordedTextures> textures);

  /// With the same textures and parameters, another kernel of the same Program.
  BoundKernel with(std::shared_ptr<const Kernel> kernel) const {
    return {std::move(kernel), textures_};
  }

  /// Inputs, outputs, parameters and textures, in the order run() wants them.
  const Program& program() const { return kernel_->program(); }
  /// The code without its bindings.
  const Kernel& kernel() const { return *kernel_; }

  /// Whether its code is still being made, and it is interpreted meanwhile; see
  /// CompileOptions::asynchronous.
  bool is_pending() const;
  /// Waits until nothing is pending. Whether it runs as it was asked to: false where it stays
  /// interpreted though machine code was wanted.
  bool wait() const;
  /// Withdraws what is pending: it stays interpreted, unless another kernel wants the same code.
  void cancel() const;
  /// Calls once when nothing is pending: at once, or from a thread that compiles.
  void when_ended(std::function<void()> call) const;
  /// What there is to say of making it, once nothing is pending: why it stays interpreted,
  /// say. Without `asynchronous`, compiling has said that already.
  Diagnostics diagnostics() const;

  /// Points so far that were computed as if CompileOptions::facts had said nothing: those of groups
  /// of 16 of which one was outside.
  std::uint64_t points_outside_facts() const;

  /// Whether calls fit what it reads to values of its parameters: then who keeps those should keep
  /// a LastFitted.
  bool is_fitted() const { return fits_ != nullptr; }

  /// The parameter block as the document has it, to be changed and passed to run().
  const std::vector<std::uint32_t>& parameters() const { return parameters_; }
  /// Index of a slot in the block, if this kernel reads it.
  std::optional<std::size_t> parameter_index(std::string_view name) const;

  /// For points of which so much is known, for each of Program::inputs: with those tiles of sets
  /// that ShaderOptions::defer_tiles has left for later and such points may read. A tile that
  /// cannot be had is an error.
  BoundKernel within(std::span<const Range> inputs, Diagnostics& diagnostics) const;
  /// Whether there are such tiles.
  bool has_deferred_tiles() const;

  /// The files that its nodes read, images above all, and what they were then, without deferred
  /// tiles that are not loaded; see RecordedTextures::files.
  const std::map<std::string, FileIdentity>& files() const { return files_; }

  /// See KernelArguments and RunStatus. `parameters` empty: those of the document. As many
  /// of each as the Program has, else nothing is run: RunStatus::wrong_arguments.
  [[nodiscard]] RunStatus run(std::span<const void* const> inputs, std::span<void* const> outputs,
                              std::uint64_t count, std::span<const std::uint32_t> parameters = {},
                              const std::atomic<std::uint32_t>* stop = nullptr) const;

  /// The same for arrays as a host has them: see runtime/batch. `binding` was made for this
  /// kernel's Program. `last`: what goes with the parameters where somebody keeps them.
  [[nodiscard]] RunStatus run(const Binding& binding, const Batch& batch,
                              std::span<const std::uint32_t> parameters = {},
                              LastFitted* last = nullptr) const;

  /// The code itself with values of its parameters, as many as the Program has, and the images that
  /// are bound now; null where there is none. `single`: for one point at a time, see
  /// CompileOptions::single_points.
  std::unique_ptr<const BoundCode> code(std::vector<std::uint32_t> parameters, bool single) const;

 private:
  /// Null for what is not machine code.
  CompiledKernel* made() const;
  /// All but the arrays; `run` runs the kernel with them.
  template <class Run>
  RunStatus with_arguments(std::span<const std::uint32_t> parameters,
                           const std::atomic<std::uint32_t>* stop, LastFitted* last,
                           Run&& run) const;

  std::shared_ptr<const Kernel> kernel_;
  std::shared_ptr<const RecordedTextures> textures_;
  std::vector<TextureBinding> bindings_;
  std::vector<TextureHandle> tiles_;  ///< Hold what within() has bound.
  std::map<std::string, FileIdentity> files_;
  bool may_change_ = false;  ///< Then `bindings_` are those of the time when it was made.
  std::vector<std::uint32_t> parameters_;
  std::shared_ptr<const ParameterFits> fits_;  ///< Null: nothing is fitted.
};

}  // namespace nacre
