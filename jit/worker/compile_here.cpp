#include "jit/worker/compiler.h"
#include "runtime/process_end.h"
#include "runtime/program/recorder.h"

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

/// LLVM's tables and those of our emitter are made when they are first read: now, because they
/// must outlive the threads that read them, and because a child of fork() would wait for ever for
/// what another thread was about to make.
bool make_tables() {
  const Program nothing = Recorder().take();
  Diagnostics ignored;
  CodegenOptions quick;  // Some milliseconds less, and the same tables.
  quick.tier = Tier::quick;
  (void)compile_object(nothing, quick, ignored);
  wait_for_work_at_exit();
  return true;
}

}  // namespace

std::unique_ptr<Compiler> make_compiler_here() {
  static const bool is_ready = make_tables();
  (void)is_ready;
  return std::make_unique<CompilerHere>();
}

}  // namespace nacre
