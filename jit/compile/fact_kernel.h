#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "jit/service/compile_service.h"
#include "runtime/kernel.h"

namespace nacre {

/// A kernel of with_check() as one without: points of which its facts do not hold are computed by
/// another, which was told none.
class FactKernel final : public CompiledKernel {
 public:
  /// `general` makes that one when it is needed, by the thread that does, at most once, which takes
  /// as long as passes do; never null.
  using MakeGeneral = std::function<std::shared_ptr<const Kernel>()>;

  FactKernel(std::shared_ptr<const Kernel> narrow, MakeGeneral general);
  ~FactKernel() override;

  RunStatus run(const KernelArguments& arguments) const override;
  const Program& program() const override;
  int lanes() const override { return narrow_->lanes(); }
  const char* engine() const override { return narrow_->engine(); }

  Fits fits() const override;
  State state() const override;
  /// That of the general kernel, which is waited for: what calls code directly gets no checks.
  std::optional<Code> code(bool single) const override;
  bool wait() const override;
  void cancel() override;
  void when_ended(std::function<void()> call) override;
  CompileStats stats() const override;
  Diagnostics diagnostics() const override;

  /// Points so far that the general kernel had to compute: those of groups of 16 of which one was
  /// outside of what was said.
  std::uint64_t points_outside() const;

 private:
  class General;

  CompiledKernel* compiled() const;

  std::shared_ptr<const Kernel> narrow_;
  Program program_;  ///< Without the channel that says whether facts hold.
  std::unique_ptr<General> general_;
};

}  // namespace nacre
