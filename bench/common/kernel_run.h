#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "jit/shading/bound_kernel.h"

namespace nacre::bench {

/// Points of a batch: a kernel's arrays stay in the L2 cache, most in L1.
inline constexpr std::size_t batch_points = 4096;

/// Arrays by channel name, `batch_points` long.
using Columns = std::map<std::string, std::vector<float>>;

/// A kernel bound to arrays of its own.
class KernelRun {
 public:
  /// Channels that are not `given` hold shading points (points.h). `kept` lives as long.
  explicit KernelRun(BoundKernel kernel, const Columns& given = {},
                     std::shared_ptr<const void> kept = {});

  /// Computes the batch.
  void operator()() { kernel_.run(inputs_, outputs_, batch_points); }

  const Kernel& kernel() const { return kernel_.kernel(); }
  const Program& program() const { return kernel_.program(); }
  /// After a run; integers as the floats of their values.
  Columns results() const;
  /// As they are, to be the inputs of another kernel.
  Columns raw_results() const;
  /// The array of an input or output, four bytes an element.
  const float* input(const std::string& channel) const;

  /// What the benchmark tells besides the time.
  std::map<std::string, double> counters;

 private:
  std::shared_ptr<const void> kept_;
  BoundKernel kernel_;
  std::vector<std::vector<float>> arrays_;  ///< Inputs, then outputs.
  std::vector<const void*> inputs_;
  std::vector<void*> outputs_;
};

}  // namespace nacre::bench
