#include "bench/common/kernel_run.h"

#include <bit>
#include <utility>

#include "bench/common/points.h"

namespace nacre::bench {

KernelRun::KernelRun(BoundKernel kernel, const Columns& given, std::shared_ptr<const void> kept)
    : kept_(std::move(kept)), kernel_(std::move(kernel)) {
  for (const Channel& channel : program().inputs) {
    const auto found = given.find(channel.name);
    arrays_.push_back(found != given.end() ? found->second : shading_points(channel));
  }
  for (std::size_t k = 0; k < program().outputs.size(); ++k) arrays_.emplace_back(batch_points);
  const std::size_t count = program().inputs.size();
  for (std::size_t k = 0; k < count; ++k) inputs_.push_back(arrays_[k].data());
  for (std::size_t k = count; k < arrays_.size(); ++k) outputs_.push_back(arrays_[k].data());
}

Columns KernelRun::raw_results() const {
  Columns columns;
  for (std::size_t k = 0; k < program().outputs.size(); ++k) {
    columns[program().outputs[k].name] = arrays_[inputs_.size() + k];
  }
  return columns;
}

Columns KernelRun::results() const {
  Columns columns = raw_results();
  for (const Channel& channel : program().outputs) {
    if (channel.type == Scalar::f32) continue;
    for (float& x : columns[channel.name]) x = static_cast<float>(std::bit_cast<std::int32_t>(x));
  }
  return columns;
}

const float* KernelRun::input(const std::string& channel) const {
  for (std::size_t k = 0; k < program().inputs.size(); ++k) {
    if (program().inputs[k].name == channel) return arrays_[k].data();
  }
  return nullptr;
}

}  // namespace nacre::bench
