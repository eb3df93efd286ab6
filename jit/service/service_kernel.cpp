#include "jit/service/service_kernel.h"

#include <utility>

#include "jit/llvm/run_code.h"
#include "runtime/interpreter/interpreter.h"
#include "runtime/program/serialize.h"

namespace nacre {

namespace {

class InterpretingKernel final : public CompiledKernel {
 public:
  InterpretingKernel(Program program, std::uint64_t max_steps, Diagnostics why)
      : interpreter_(make_interpreter(std::move(program), max_steps)), why_(std::move(why)) {}

  RunStatus run(const KernelArguments& arguments) const override {
    return interpreter_->run(arguments);
  }
  const Program& program() const override { return interpreter_->program(); }
  int lanes() const override { return interpreter_->lanes(); }
  const char* engine() const override { return interpreter_->engine(); }
  State state() const override { return State::failed; }
  std::optional<Code> code(bool) const override { return std::nullopt; }
  bool wait() const override { return false; }
  void cancel() override {}
  void when_ended(std::function<void()> call) override { call(); }
  CompileStats stats() const override { return {}; }
  Diagnostics diagnostics() const override { return why_; }

 private:
  std::unique_ptr<Kernel> interpreter_;
  Diagnostics why_;
};

}  // namespace

ServiceKernel::ServiceKernel(std::shared_ptr<const Program> program, const CodegenOptions& options,
                             std::shared_ptr<CompileJob> job, std::unique_ptr<Kernel> interpreter)
    : program_(std::move(program)),
      lanes_(options.lanes),
      limit_(*program_, options.max_steps),
      job_(std::move(job)),
      interpreter_(std::move(interpreter)) {}

ServiceKernel::~ServiceKernel() { cancel(); }

RunStatus ServiceKernel::run(const KernelArguments& arguments) const {
  // Code that was seen once stays: the job holds it, and this kernel the job.
  const LoadedCode::Entry entry = job_->entry();
  if (entry == nullptr) return interpreter_->run(arguments);
  return run_code(entry, *program_, lanes_, limit_, arguments);
}

int ServiceKernel::lanes() const {
  return job_->entry() == nullptr ? interpreter_->lanes() : lanes_;
}

const char* ServiceKernel::engine() const {
  return job_->entry() == nullptr ? interpreter_->engine() : "jit";
}

std::optional<CompiledKernel::Code> ServiceKernel::code(bool single) const {
  const LoadedCode::Entry entry = job_->entry();
  if (entry == nullptr || (single && lanes_ != 1)) return std::nullopt;
  return Code{entry, lanes_, limit_.max_steps()};
}

Fits ServiceKernel::fits() const {
  if (program_->fitted_rows != 0 || job_->entry() == nullptr) return CompiledKernel::fits();
  Program from_code;
  if (!take_fits(job_->fits(), from_code)) return {};
  return {std::move(from_code.fits), from_code.fitted_rows};
}

CompiledKernel::State ServiceKernel::state() const {
  const State of_job = job_->state();
  return of_job == State::waiting && left_ ? State::cancelled : of_job;
}

Diagnostics ServiceKernel::diagnostics() const {
  Diagnostics said = job_->diagnostics();
  if (state() == State::cancelled && said.all().empty()) {
    said.warning("cancelled", {},
                 "a kernel is interpreted, because its code was withdrawn before it was there", {},
                 program_->name);
  }
  return said;
}

void ServiceKernel::cancel() {
  if (!left_.exchange(true)) job_->leave();
}

std::shared_ptr<CompiledKernel> interpreting_kernel(Program program, std::uint64_t max_steps,
                                                    Diagnostics why) {
  return std::make_shared<InterpretingKernel>(std::move(program), max_steps, std::move(why));
}

}  // namespace nacre
