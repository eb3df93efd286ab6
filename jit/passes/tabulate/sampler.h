#pragma once

#include <memory>
#include <span>
#include <vector>

#include "jit/passes/tabulate/groups.h"
#include "runtime/reference/reference.h"

namespace nacre {

/// Values of a group for other numbers than it has, in double precision.
class Sampler {
 public:
  /// `cone`: what the values are computed from.
  Sampler(const Program& program, const Cone& cone, ValueId key,
          const std::vector<ValueId>& values);

  /// See Sampled (piecewise.h).
  std::vector<std::vector<double>> run(std::span<const float> numbers) const;

 private:
  std::size_t count_;
  std::unique_ptr<ReferenceKernel> kernel_;
};

}  // namespace nacre
