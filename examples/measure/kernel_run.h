#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "jit/shading/bound_kernel.h"

namespace nacre::measure {

/// Points of a batch: a kernel's arrays stay in the L2 cache, most in L1.
inline constexpr std::size_t batch_points = 4096;

/// Arrays by channel name, `batch_points` long.
using Columns = std::map<std::string, std::vector<float>>;

/// A kernel bound to arrays of its own. They lie alike for every kernel with as many
/// channels, each on a cache line and none a multiple of a page from another: where malloc
/// puts them makes up to 8 % of a fast kernel's time.
class KernelRun {
 public:
  /// Channels that are not `given` hold shading points (points.h), which have every geometric
  /// property that the kernel asks for. `kept` lives as long.
  explicit KernelRun(BoundKernel kernel, const Columns& given = {},
                     std::shared_ptr<const void> kept = {});

  /// Computes the batch.
  void operator()() { (void)kernel_.run(inputs_, outputs_, batch_points, parameters_); }

  const Kernel& kernel() const { return kernel_.kernel(); }
  const Program& program() const { return kernel_.program(); }
  /// After a run; integers as the floats of their values.
  Columns results() const;
  /// As they are, to be the inputs of another kernel.
  Columns raw_results() const;
  /// The array of a channel, four bytes an element; null if there is none.
  const float* input(const std::string& channel) const;
  float* output(const std::string& channel) const;

  /// What the benchmark tells besides the time.
  std::map<std::string, double> counters;

 private:
  struct Free {
    void operator()(float* block) const;
  };

  std::shared_ptr<const void> kept_;
  BoundKernel kernel_;
  std::unique_ptr<float[], Free> block_;
  std::vector<const void*> inputs_;
  std::vector<void*> outputs_;
  std::vector<std::uint32_t> parameters_;
};

}  // namespace nacre::measure
