#pragma once

#include <cstdint>
#include <memory>

#include "runtime/reference/reference.h"

namespace nacre {

/// Runs a Program in double precision and adds up what it does, each operation by how much longer
/// engines take for it than for an addition. The same on every machine: for comparing Programs of
/// one document with each other. Points count one by one, as if lanes never waited for others.
/// For one thread at a time.
class CountingKernel final : public Kernel {
 public:
  explicit CountingKernel(const Program& program) : kernel_(make_reference(program)) {}

  RunStatus run(const KernelArguments& arguments) const override;
  const Program& program() const override { return kernel_->program(); }
  int lanes() const override { return kernel_->lanes(); }
  const char* engine() const override { return kernel_->engine(); }

  /// Of a point, on average of all that were run.
  double cost() const;

 private:
  std::unique_ptr<ReferenceKernel> kernel_;
  mutable OpCounts counts_{};
  mutable std::uint64_t points_ = 0;
};

}  // namespace nacre
