#include "jit/worker/compiler.h"

namespace nacre {

namespace {

class CompilerHere final : public Compiler {
 public:
  std::optional<ObjectCode> compile(const Program& program, const CodegenOptions& options,
                                    Diagnostics& diagnostics, CompileStats& stats,
                                    const std::function<bool()>& cancelled) override {
    return compile_object(program, options, diagnostics, &stats, cancelled);
  }
  std::unique_ptr<Compiler> heir() const override { return make_compiler_here(); }
};

}  // namespace

std::unique_ptr<Compiler> make_compiler_here() { return std::make_unique<CompilerHere>(); }

}  // namespace nacre
