#include "examples/measure/kernel_run.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <new>
#include <utility>

#include "jit/tune/points.h"

namespace nacre::measure {

namespace {

constexpr std::size_t page = 4096;
/// Floats from one array to the next: five cache lines more than the points.
constexpr std::size_t stride = batch_points + 80;

float* allocate(std::size_t arrays) {
  const std::size_t bytes = std::max<std::size_t>(arrays, 1) * stride * sizeof(float);
  auto* block = static_cast<float*>(std::aligned_alloc(page, (bytes + page - 1) / page * page));
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

template <class Pointers>
auto* find(const std::vector<Channel>& channels, const Pointers& arrays, const std::string& name) {
  const auto at = std::ranges::find(channels, name, &Channel::name);
  return at == channels.end() ? nullptr : arrays[static_cast<std::size_t>(at - channels.begin())];
}

}  // namespace

void KernelRun::Free::operator()(float* block) const { std::free(block); }

KernelRun::KernelRun(BoundKernel kernel, const Columns& given, std::shared_ptr<const void> kept)
    : kept_(std::move(kept)),
      kernel_(std::move(kernel)),
      block_(allocate(program().inputs.size() + program().outputs.size())),
      parameters_(kernel_.parameters()) {
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    if (program().parameters[i].name.starts_with("geomprop.")) parameters_[i] = 1;
  }
  float* next = block_.get();
  for (const Channel& channel : program().inputs) {
    const auto found = given.find(channel.name);
    std::ranges::copy(found != given.end() ? found->second : shading_points(channel, batch_points),
                      next);
    inputs_.push_back(next);
    next += stride;
  }
  for (std::size_t k = 0; k < program().outputs.size(); ++k) {
    std::fill_n(next, batch_points, 0.0f);
    outputs_.push_back(next);
    next += stride;
  }
}

Columns KernelRun::raw_results() const {
  Columns columns;
  for (const Channel& channel : program().outputs) {
    const float* from = output(channel.name);
    columns[channel.name].assign(from, from + batch_points);
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
  return static_cast<const float*>(find(program().inputs, inputs_, channel));
}

float* KernelRun::output(const std::string& channel) const {
  return static_cast<float*>(find(program().outputs, outputs_, channel));
}

}  // namespace nacre::measure
