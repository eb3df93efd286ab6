#include "jit/tune/kernel_run.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <chrono>
#include <cstdlib>
#include <new>
#include <utility>

namespace nacre {

namespace {

constexpr std::size_t page = 4096;

/// Floats from one array to the next: five cache lines or so more than the points.
std::size_t stride_of(std::size_t count) {
  constexpr std::size_t line = 16, page_floats = page / sizeof(float);
  const std::size_t stride = (count + 80 + line - 1) / line * line;
  return stride % page_floats == 0 ? stride + line : stride;
}

float* allocate(std::size_t arrays, std::size_t stride) {
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

KernelRun::KernelRun(BoundKernel kernel, const Columns& given, std::shared_ptr<const void> kept,
                     const PointSet& points)
    : kept_(std::move(kept)),
      kernel_(std::move(kernel)),
      points_(points),
      block_(allocate(program().inputs.size() + program().outputs.size(), stride_of(points.count))),
      parameters_(kernel_.parameters()) {
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    if (program().parameters[i].name.starts_with("geomprop.")) parameters_[i] = 1;
  }
  const std::size_t stride = stride_of(count());
  float* next = block_.get();
  for (const Channel& channel : program().inputs) {
    const auto found = given.find(channel.name);
    const std::vector<float> column =
        found != given.end() ? found->second : shading_points(channel, points_);
    assert(column.size() >= count());
    std::copy_n(column.begin(), count(), next);
    inputs_.push_back(next);
    next += stride;
  }
  for (std::size_t k = 0; k < program().outputs.size(); ++k) {
    std::fill_n(next, count(), 0.0f);
    outputs_.push_back(next);
    next += stride;
  }
}

bool KernelRun::operator()(const Stop& stop) {
  // What a kernel sums over facets takes long for each point in double precision.
  constexpr std::size_t points_between_looks = 256;
  std::vector<const void*> from = inputs_;
  std::vector<void*> to = outputs_;
  for (std::size_t first = 0; first < count(); first += points_between_looks) {
    if (stop.is_due()) return false;
    for (std::size_t k = 0; k < from.size(); ++k) {
      from[k] = static_cast<const float*>(inputs_[k]) + first;
    }
    for (std::size_t k = 0; k < to.size(); ++k) to[k] = static_cast<float*>(outputs_[k]) + first;
    const std::size_t some = std::min(points_between_looks, count() - first);
    if (kernel_.run(from, to, some, parameters_) != RunStatus::done) return false;
  }
  return true;
}

Columns KernelRun::raw_results() const {
  Columns columns;
  for (const Channel& channel : program().outputs) {
    const float* from = output(channel.name);
    columns[channel.name].assign(from, from + count());
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

double nanoseconds_a_point(KernelRun& run, double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto since = [](Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  double best = 1e300;
  for (const Clock::time_point begun = Clock::now(); since(begun) < seconds;) {
    const Clock::time_point start = Clock::now();
    run();
    best = std::min(best, since(start));
  }
  return 1e9 * best / static_cast<double>(run.count());
}

}  // namespace nacre
