#include "jit/shading/bound_kernel.h"

#include <utility>

#include "jit/compile/fact_kernel.h"
#include "jit/compile/parameter_fits.h"
#include "jit/passes/reached_tiles.h"
#include "jit/record/textures.h"
#include "jit/service/compile_service.h"
#include "jit/shading/bound_code.h"
#include "runtime/batch/run_bound.h"

namespace nacre {

BoundKernel::BoundKernel(std::shared_ptr<const Kernel> kernel,
                         std::shared_ptr<const RecordedTextures> textures)
    : kernel_(std::move(kernel)), textures_(std::move(textures)) {
  if (textures_ != nullptr) {
    bindings_ = textures_->snapshot().bindings;
    may_change_ = textures_->may_change();
    files_ = textures_->files();
  }
  for (const ParameterSlot& slot : program().parameters) parameters_.push_back(slot.value);
  fits_ = ParameterFits::make(*kernel_);
}

CompiledKernel* BoundKernel::made() const {
  // What it computes stays the same, whoever cancels or waits.
  return dynamic_cast<CompiledKernel*>(const_cast<Kernel*>(kernel_.get()));
}

bool BoundKernel::is_pending() const {
  return made() != nullptr && made()->state() == CompiledKernel::State::waiting;
}

bool BoundKernel::wait() const { return made() == nullptr || made()->wait(); }

void BoundKernel::cancel() const {
  if (made() != nullptr) made()->cancel();
}

void BoundKernel::when_ended(std::function<void()> call) const {
  if (made() == nullptr) return call();
  made()->when_ended(std::move(call));
}

Diagnostics BoundKernel::diagnostics() const {
  return made() != nullptr ? made()->diagnostics() : Diagnostics();
}

std::uint64_t BoundKernel::points_outside_facts() const {
  const auto* checked = dynamic_cast<const FactKernel*>(kernel_.get());
  return checked != nullptr ? checked->points_outside() : 0;
}

std::unique_ptr<const BoundCode> BoundKernel::code(std::vector<std::uint32_t> parameters,
                                                   bool single) const {
  const auto code = made() != nullptr ? made()->code(single) : std::nullopt;
  if (!code || parameters.size() != parameters_.size()) return nullptr;
  auto bound = std::make_unique<BoundCode>();
  bound->code = *code;
  bound->parameters = std::move(parameters);
  if (textures_ != nullptr) bound->images = textures_->snapshot();
  if (fits_ != nullptr) bound->fitted = fits_->of(bound->parameters);
  bound->arguments = {.parameters = bound->parameters.data(),
                      .fitted = bound->fitted != nullptr ? bound->fitted->data() : nullptr,
                      .textures = bound->images.bindings.data(),
                      .texture_callback = &RecordedTextures::look_up,
                      .texture_user = const_cast<RecordedTextures*>(textures_.get())};
  bound->kernel = kernel_;
  bound->textures = textures_;
  return bound;
}

std::optional<std::size_t> BoundKernel::parameter_index(std::string_view name) const {
  const auto& slots = program().parameters;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (slots[i].name == name) return i;
  }
  return std::nullopt;
}

bool BoundKernel::has_deferred_tiles() const {
  return textures_ != nullptr && textures_->has_deferred();
}

BoundKernel BoundKernel::within(std::span<const Range> inputs, Diagnostics& diagnostics) const {
  BoundKernel bound = *this;
  if (!has_deferred_tiles()) return bound;
  bound.files_ = textures_->files();
  RecordedTextures::Snapshot now =
      textures_->load_tiles(reached_textures(program(), inputs), bound.files_, diagnostics);
  bound.bindings_ = std::move(now.bindings);
  bound.tiles_ = std::move(now.textures);
  return bound;
}

template <class Run>
RunStatus BoundKernel::with_arguments(std::span<const std::uint32_t> parameters,
                                      const std::atomic<std::uint32_t>* stop, LastFitted* last,
                                      Run&& run) const {
  if (parameters.empty()) parameters = parameters_;
  const auto fitted = fits_ != nullptr ? fits_->of(parameters, last) : nullptr;
  KernelArguments all{.parameters = parameters.data(),
                      .fitted = fitted != nullptr ? fitted->data() : nullptr,
                      .textures = bindings_.data(),
                      .texture_callback = &RecordedTextures::look_up,
                      .texture_user = const_cast<RecordedTextures*>(textures_.get()),
                      .stop = stop};
  if (!may_change_) return run(all);
  const RecordedTextures::Snapshot now = textures_->snapshot();
  all.textures = now.bindings.data();
  return run(all);
}

RunStatus BoundKernel::run(std::span<const void* const> inputs, std::span<void* const> outputs,
                           std::uint64_t count, std::span<const std::uint32_t> parameters,
                           const std::atomic<std::uint32_t>* stop) const {
  const bool fits = inputs.size() == program().inputs.size() &&
                    outputs.size() == program().outputs.size() &&
                    (parameters.empty() || parameters.size() == parameters_.size());
  if (!fits) return RunStatus::wrong_arguments;
  return with_arguments(parameters, stop, nullptr, [&](KernelArguments& all) {
    all.inputs = inputs.data();
    all.outputs = outputs.data();
    all.count = count;
    return kernel_->run(all);
  });
}

RunStatus BoundKernel::run(const Binding& binding, const Batch& batch,
                           std::span<const std::uint32_t> parameters, LastFitted* last) const {
  const bool fits = binding.inputs.size() == program().inputs.size() &&
                    binding.outputs.size() == program().outputs.size() &&
                    (parameters.empty() || parameters.size() == parameters_.size());
  if (!fits) return RunStatus::wrong_arguments;
  return with_arguments(parameters, batch.stop, last, [&](KernelArguments& all) {
    return run_bound(
        binding, batch,
        [this, &all](const void* const* inputs, void* const* outputs, std::uint64_t count) {
          all.inputs = inputs;
          all.outputs = outputs;
          all.count = count;
          return kernel_->run(all);
        });
  });
}

}  // namespace nacre
