#include "bench/accuracy/sweep.h"

#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <mutex>
#include <thread>

#include "bench/accuracy/pairs.h"
#include "runtime/program/fold.h"

namespace nacre {

namespace {

constexpr std::uint64_t block = 1u << 14;

double argument(std::uint32_t bits) {
  return static_cast<double>(std::bit_cast<float>(flush_denormal(bits)));
}

class Sweep {
 public:
  Sweep(const MathFunction& function, const std::vector<std::shared_ptr<const Kernel>>& kernels,
        const SweepOptions& options, const std::function<void(double)>& progress)
      : function_(function),
        kernels_(kernels),
        options_(options),
        progress_(progress),
        total_(function.arguments == 2 ? edge_pair_count() + options.pairs
                                       : ((std::uint64_t{1} << 32) - 1) / options.stride + 1) {}

  SweepResult run() {
    const auto start = std::chrono::steady_clock::now();
    std::vector<std::thread> threads;
    for (int i = 0; i < options_.threads; ++i) threads.emplace_back([this] { work(); });
    for (std::thread& thread : threads) thread.join();
    result_.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result_;
  }

 private:
  Pair arguments(std::uint64_t index) const {
    if (function_.arguments == 2) return pair_of(function_.op, index);
    return {static_cast<std::uint32_t>(index * options_.stride), 0};
  }

  void work() {
    std::vector<std::uint32_t> x(block);
    std::vector<std::uint32_t> y(block);
    std::vector<double> truth(block);
    std::vector<float> got(block);
    std::array<ModeErrors, accuracy_modes.size()> errors;
    for (;;) {
      const std::uint64_t first = next_.fetch_add(block);
      if (first >= total_) break;
      const std::uint64_t count = std::min(block, total_ - first);
      for (std::uint64_t i = 0; i < count; ++i) {
        const Pair pair = arguments(first + i);
        x[i] = pair.x;
        y[i] = pair.y;
        truth[i] = function_.truth(argument(pair.x), argument(pair.y));
      }
      for (std::size_t mode = 0; mode < kernels_.size(); ++mode) {
        const std::array<const void*, 2> inputs{x.data(), y.data()};
        void* output = got.data();
        kernels_[mode]->run({.inputs = inputs.data(), .outputs = &output, .count = count});
        for (std::uint64_t i = 0; i < count; ++i) {
          errors[mode].all.add(got[i], truth[i], x[i], y[i]);
          if (std::fabs(argument(x[i])) > static_cast<double>(function_.near)) continue;
          errors[mode].near.add(got[i], truth[i], x[i], y[i]);
        }
      }
      progress_(static_cast<double>(first) / static_cast<double>(total_));
    }
    const std::lock_guard lock(mutex_);
    for (std::size_t mode = 0; mode < kernels_.size(); ++mode) {
      result_.modes[mode].all.merge(errors[mode].all);
      result_.modes[mode].near.merge(errors[mode].near);
    }
  }

  const MathFunction& function_;
  const std::vector<std::shared_ptr<const Kernel>>& kernels_;
  const SweepOptions& options_;
  const std::function<void(double)>& progress_;
  std::uint64_t total_;
  std::atomic<std::uint64_t> next_{0};
  std::mutex mutex_;
  SweepResult result_;
};

}  // namespace

SweepResult sweep(const MathFunction& function,
                  const std::vector<std::shared_ptr<const Kernel>>& kernels,
                  const SweepOptions& options, const std::function<void(double)>& progress) {
  return Sweep(function, kernels, options, progress).run();
}

}  // namespace nacre
