#include <vector>

#include "jit/worker/compiler.h"
#include "runtime/process_end.h"
#include "runtime/program/recorder.h"
#include "runtime/program/slice.h"
#include "runtime/value/control.h"

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

/// Has what LLVM has tables for: a loop, out of which it takes what stays the same, and literals
/// in memory, which it makes smaller.
Program small_loop() {
  Recorder recorder;
  const Float x(recorder.input("x", Scalar::f32));
  const Float sum = loop(recorder, Bool(true), 8, x, [&](Int k, Float& value) {
    value = fma(value, 0.3f, x / Float(0.7f));
    return to_float(k) < value;
  });
  const std::vector<SliceOutput> outputs{{"sum", sum.ref()}};
  return slice(recorder.program(), "tables", outputs);
}

/// LLVM's tables and those of our emitter are made when they are first read: now, because they
/// must outlive the threads that read them, and because a child of fork() would wait for ever for
/// what another thread was about to make.
bool make_tables() {
  Diagnostics ignored;
  (void)compile_object(small_loop(), {}, ignored);
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
