#include "jit/shading/bound_kernel.h"

#include <utility>

#include "jit/record/textures.h"
#include "jit/service/compile_service.h"
#include "runtime/batch/run_bound.h"

namespace nacre {

BoundKernel::BoundKernel(std::shared_ptr<const Kernel> kernel,
                         std::shared_ptr<const RecordedTextures> textures)
    : kernel_(std::move(kernel)), textures_(std::move(textures)) {
  if (textures_ != nullptr) bindings_ = textures_->bindings();
  for (const ParameterSlot& slot : program().parameters) parameters_.push_back(slot.value);
}

bool BoundKernel::is_pending() const {
  const auto* made = dynamic_cast<const CompiledKernel*>(kernel_.get());
  return made != nullptr && made->state() == CompiledKernel::State::waiting;
}

bool BoundKernel::wait() const {
  const auto* made = dynamic_cast<const CompiledKernel*>(kernel_.get());
  return made == nullptr || made->wait();
}

Diagnostics BoundKernel::diagnostics() const {
  const auto* made = dynamic_cast<const CompiledKernel*>(kernel_.get());
  return made != nullptr ? made->diagnostics() : Diagnostics();
}

std::optional<std::size_t> BoundKernel::parameter_index(std::string_view name) const {
  const auto& slots = program().parameters;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (slots[i].name == name) return i;
  }
  return std::nullopt;
}

KernelArguments BoundKernel::arguments(std::span<const std::uint32_t> parameters,
                                       const std::atomic<std::uint32_t>* stop) const {
  return {.parameters = parameters.empty() ? parameters_.data() : parameters.data(),
          .textures = bindings_.data(),
          .texture_callback = &RecordedTextures::look_up,
          .texture_user = const_cast<RecordedTextures*>(textures_.get()),
          .stop = stop};
}

RunStatus BoundKernel::run(std::span<const void* const> inputs, std::span<void* const> outputs,
                           std::uint64_t count, std::span<const std::uint32_t> parameters,
                           const std::atomic<std::uint32_t>* stop) const {
  const bool fits = inputs.size() == program().inputs.size() &&
                    outputs.size() == program().outputs.size() &&
                    (parameters.empty() || parameters.size() == parameters_.size());
  if (!fits) return RunStatus::wrong_arguments;
  KernelArguments all = arguments(parameters, stop);
  all.inputs = inputs.data();
  all.outputs = outputs.data();
  all.count = count;
  return kernel_->run(all);
}

RunStatus BoundKernel::run(const Binding& binding, const Batch& batch,
                           std::span<const std::uint32_t> parameters) const {
  const bool fits = binding.inputs.size() == program().inputs.size() &&
                    binding.outputs.size() == program().outputs.size() &&
                    (parameters.empty() || parameters.size() == parameters_.size());
  if (!fits) return RunStatus::wrong_arguments;
  KernelArguments all = arguments(parameters, batch.stop);
  return run_bound(
      binding, batch,
      [this, &all](const void* const* inputs, void* const* outputs, std::uint64_t count) {
        all.inputs = inputs;
        all.outputs = outputs;
        all.count = count;
        return kernel_->run(all);
      });
}

}  // namespace nacre
