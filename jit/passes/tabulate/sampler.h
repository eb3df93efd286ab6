#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "jit/passes/tabulate/groups.h"
#include "runtime/reference/reference.h"

namespace nacre {

struct Looked;

/// A Program of one input, the number, and of the parameters that `program` has and values need;
/// its outputs are the values.
Program program_of(const Program& program, const Cone& cone, ValueId key,
                   const std::vector<ValueId>& values);

/// Values of a group for other numbers than it has, in double precision.
class Sampler {
 public:
  /// `cone`: what the values are computed from.
  Sampler(const Program& program, const Cone& cone, ValueId key,
          const std::vector<ValueId>& values);
  /// Where some are looked up.
  Sampler(const Program& program, const Groups& groups, const Cone& cone, ValueId key,
          const std::vector<ValueId>& values, const std::vector<Looked>& plan);

  /// See Sampled (piecewise.h).
  std::vector<std::vector<double>> run(std::span<const float> numbers) const;

 private:
  void make(Program program);

  std::size_t count_;
  std::unique_ptr<ReferenceKernel> kernel_;
};

}  // namespace nacre
