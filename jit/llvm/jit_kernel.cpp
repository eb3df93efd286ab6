#include <utility>

#include "jit/llvm/run_code.h"

namespace nacre {

namespace {

class JitKernel final : public Kernel {
 public:
  JitKernel(Program program, std::shared_ptr<const LoadedCode> code, int lanes)
      : program_(std::move(program)), code_(std::move(code)), lanes_(lanes) {}

  void run(const KernelArguments& arguments) const override {
    run_code(code_->entry(), program_, lanes_, arguments);
  }
  const Program& program() const override { return program_; }
  int lanes() const override { return lanes_; }
  const char* engine() const override { return "jit"; }

 private:
  Program program_;
  std::shared_ptr<const LoadedCode> code_;
  int lanes_;
};

}  // namespace

std::shared_ptr<const Kernel> make_jit_kernel(Program program,
                                              std::shared_ptr<const LoadedCode> code, int lanes) {
  return std::make_shared<JitKernel>(std::move(program), std::move(code), lanes);
}

}  // namespace nacre
