#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "runtime/kernel.h"
#include "runtime/program/cost.h"

namespace nacre {

/// How often each operation was done, by Op.
using OpCounts = std::array<std::uint64_t, op_count>;

/// A kernel that runs `program`, each point as if it were alone, in double precision, its
/// transcendental functions those of the C library: the oracle for every
/// error figure. Give it the Program before its math is expanded. Integer
/// operations, and the bits that `bits` and `from_bits` show, are those of the
/// other engines.
///
/// Beside run(), which rounds the results to float, run_double() stores them
/// as they are.
class ReferenceKernel : public Kernel {
 public:
  /// As run(), but every f32 output is an array of doubles.
  virtual RunStatus run_double(const KernelArguments& arguments) const = 0;
  /// As run(), and adds up what was done, point by point: no region that a point does not enter.
  virtual RunStatus run_counted(const KernelArguments& arguments, OpCounts& counts) const = 0;
};

/// Never null. `max_steps` as of StepLimit.
std::unique_ptr<ReferenceKernel> make_reference(Program program,
                                                std::uint64_t max_steps = default_max_steps);

}  // namespace nacre
