#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "jit/llvm/codegen.h"
#include "runtime/diagnostic.h"
#include "runtime/program/program.h"

namespace nacre {

/// Makes machine code of Programs, on any thread with a stack as compile_object() wants it.
class Compiler {
 public:
  virtual ~Compiler() = default;

  /// As compile_object(). Without an error, and with a warning "compile-failed", where it is
  /// the compiler's fault and not the Program's: then the kernel can still be interpreted.
  virtual std::optional<ObjectCode> compile(const Program& program, const CodegenOptions& options,
                                            Diagnostics& diagnostics, CompileStats& stats,
                                            const std::function<bool()>& cancelled) = 0;
  /// Somebody will soon call compile(): what takes long to begin may begin.
  virtual void prepare() {}
  /// The same for a child of fork().
  virtual std::unique_ptr<Compiler> heir() const = 0;
};

/// In this process, whose end a fault of LLVM's is.
std::unique_ptr<Compiler> make_compiler_here();

/// What a process that compiles may take.
struct WorkerLimits {
  double seconds = 300;                ///< For one Program.
  std::uint64_t megabytes = 8 * 1024;  ///< Of address space beside the program; 0: any.
};

/// In processes of their own, started when they are needed and kept: one that crashes, hangs,
/// runs out of memory or is no longer wanted is ended, and another takes its place.
/// `program` is nacre-compile-worker, of this version: see find_worker().
std::unique_ptr<Compiler> make_compiler_apart(std::filesystem::path program,
                                              const WorkerLimits& limits = {});

/// The nacre-compile-worker that came with this library or tool: what NACRE_COMPILE_WORKER
/// names, or from where that lies (runtime/own_file.h). Empty if there is none.
std::filesystem::path find_worker();

}  // namespace nacre
