#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "jit/service/compile_service.h"
#include "jit/service/job.h"

namespace nacre {

/// A Program of its own and the job it shares: names and keys of what is bound
/// may differ between Programs with the same code.
class ServiceKernel final : public CompiledKernel {
 public:
  /// `interpreter` answers until the code is there; null if that is awaited. The
  /// job has been joined.
  ServiceKernel(std::shared_ptr<const Program> program, const CodegenOptions& options,
                std::shared_ptr<CompileJob> job, std::unique_ptr<Kernel> interpreter);
  ~ServiceKernel() override;

  RunStatus run(const KernelArguments& arguments) const override;
  const Program& program() const override { return *program_; }
  int lanes() const override;
  const char* engine() const override;

  Fits fits() const override;
  State state() const override;
  std::optional<Code> code(bool single) const override;
  bool wait() const override { return left_ ? job_->entry() != nullptr : job_->wait(); }
  void cancel() override;
  void when_ended(std::function<void()> call) override { job_->when_ended(std::move(call)); }
  CompileStats stats() const override { return job_->stats(); }
  Diagnostics diagnostics() const override;

 private:
  std::shared_ptr<const Program> program_;
  int lanes_;
  StepLimit limit_;
  std::shared_ptr<CompileJob> job_;
  std::unique_ptr<Kernel> interpreter_;
  std::atomic<bool> left_ = false;
};

/// A kernel for where there is no JIT: it never becomes ready.
std::shared_ptr<CompiledKernel> interpreting_kernel(Program program, std::uint64_t max_steps,
                                                    Diagnostics why);

}  // namespace nacre
