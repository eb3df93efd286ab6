#include <utility>

#include "jit/llvm/run_code.h"

namespace nacre {

namespace {

class JitKernel final : public Kernel {
 public:
  JitKernel(Program program, std::shared_ptr<const LoadedCode> code, int lanes,
            std::uint64_t max_steps)
      : program_(std::move(program)),
        code_(std::move(code)),
        lanes_(lanes),
        limit_(program_, max_steps) {}

  RunStatus run(const KernelArguments& arguments) const override {
    return run_code(code_->entry(), program_, lanes_, limit_, arguments);
  }
  const Program& program() const override { return program_; }
  int lanes() const override { return lanes_; }
  const char* engine() const override { return "jit"; }

 private:
  Program program_;
  std::shared_ptr<const LoadedCode> code_;
  int lanes_;
  StepLimit limit_;
};

}  // namespace

std::shared_ptr<const Kernel> make_jit_kernel(Program program,
                                              std::shared_ptr<const LoadedCode> code, int lanes,
                                              std::uint64_t max_steps) {
  return std::make_shared<JitKernel>(std::move(program), std::move(code), lanes, max_steps);
}

}  // namespace nacre
