#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "jit/shading/bound_kernel.h"
#include "jit/tune/error.h"
#include "jit/tune/points.h"
#include "runtime/stop.h"

namespace nacre {

/// A kernel bound to arrays of its own. They lie alike for every kernel with as many
/// channels, each on a cache line and none a multiple of a page from another: where malloc
/// puts them makes up to 8 % of a fast kernel's time.
class KernelRun {
 public:
  /// Channels that are not `given` hold shading_points(), which have every geometric property that
  /// the kernel asks for; given ones have as many elements, or more. `kept` lives as long.
  explicit KernelRun(BoundKernel kernel, const Columns& given = {},
                     std::shared_ptr<const void> kept = {}, const PointSet& points = {});

  /// Computes all points; whether to the end.
  bool operator()() {
    return kernel_.run(inputs_, outputs_, points_.count, parameters_) == RunStatus::done;
  }
  /// The same unless `stop` is due meanwhile.
  bool operator()(const Stop& stop);

  const Kernel& kernel() const { return kernel_.kernel(); }
  std::size_t count() const { return points_.count; }
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
  PointSet points_;
  std::unique_ptr<float[], Free> block_;
  std::vector<const void*> inputs_;
  std::vector<void*> outputs_;
  std::vector<std::uint32_t> parameters_;
};

/// Of a point, in the fastest of the runs that fit into so many seconds: whatever else the machine
/// does makes some slower.
double nanoseconds_a_point(KernelRun& run, double seconds);

}  // namespace nacre
