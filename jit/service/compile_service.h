#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "jit/llvm/codegen.h"
#include "jit/llvm/session.h"
#include "jit/service/threads.h"
#include "jit/worker/compiler.h"
#include "runtime/diagnostic.h"
#include "runtime/kernel.h"
#include "runtime/stop.h"

namespace nacre {

/// As in a Program.
struct Fits {
  std::vector<Fit> list;
  std::uint32_t rows = 0;
};

/// A kernel that the service makes. Until its code is ready, and if it never
/// will be, run() answers through the interpreter, with the same bits.
class CompiledKernel : public Kernel {
 public:
  enum class State { waiting, ready, failed, cancelled };

  /// The code itself; see run_code.h for what it wants.
  struct Code {
    LoadedCode::Entry entry;
    int lanes;
    std::uint64_t max_steps;  ///< Of a pass.
  };

  /// What KernelArguments::fitted has, with Program::fitted_rows: of code that was there already
  /// program() may not say it.
  virtual Fits fits() const { return {program().fits, program().fitted_rows}; }

  virtual State state() const = 0;
  /// Nothing unless ready. `single`: of one lane, where CompileOptions::single_points asked for it.
  virtual std::optional<Code> code(bool single) const = 0;
  /// Waits for the code; true if it is there.
  virtual bool wait() const = 0;
  /// Withdraws the request: if no other kernel wants the same code, compiling
  /// ends at the next stage or does not begin. The kernel stays usable.
  virtual void cancel() = 0;
  /// Calls once when it is no longer waiting: at once, or from the thread that compiles.
  virtual void when_ended(std::function<void()> call) = 0;
  /// Where the time went. Zeros until ready.
  virtual CompileStats stats() const = 0;
  /// Why it failed or was given up, and warnings about the cache. Empty while waiting.
  virtual Diagnostics diagnostics() const = 0;
};

/// A Program and what its code is known by: code_key() of it, or of a Program that it is
/// always made of.
struct CodeRequest {
  Program program;
  std::string key;
};

struct ServiceOptions {
  int threads = 0;              ///< That compile; 0: one a core.
  std::filesystem::path cache;  ///< Folder of compiled kernels; empty: none is kept.
  SessionOptions session;
  /// nacre-compile-worker, which compiles in processes of its own; empty: in this one.
  std::filesystem::path worker = {};
  WorkerLimits worker_limits = {};
  std::shared_ptr<Executor> executor = nullptr;  ///< In place of threads of our own.
};

/// Compiles Programs on its own threads (with stacks of 16 MiB). Programs that
/// need the same code share it: what is being compiled or alive is not compiled
/// again. All members may be called from any thread. Kernels may outlive it.
///
/// In a child of fork() ready kernels stay, those under way are interpreted, and what is
/// requested is compiled by threads of the child's own; but interpreted, with a warning, if
/// one was being compiled at the fork.
class CompileService : public std::enable_shared_from_this<CompileService> {
 public:
  /// Never null. Where the system allows no code to be made at run time, and
  /// where the cache is not to be trusted, that is a warning.
  static std::unique_ptr<CompileService> create(const ServiceOptions& options,
                                                Diagnostics& diagnostics);
  /// Cancels what is not finished.
  virtual ~CompileService() = default;

  /// A kernel whose code is there already, of another kernel or in the cache; null if there
  /// is none. `program` as in CodeRequest, or as yet unfinished: it says what is bound.
  virtual std::shared_ptr<CompiledKernel> find(const Program& program, const std::string& key,
                                               const CodegenOptions& options) = 0;

  /// Compiles them side by side and returns when all are ready, or `stop` is due.
  /// Null, with a diagnostic, for those that LLVM refuses and where a stop was requested;
  /// interpreting kernels for those that are late, with a warning, where the system has
  /// no memory for code, and where there is no JIT at all.
  virtual std::vector<std::shared_ptr<CompiledKernel>> request_all(
      std::vector<CodeRequest> requests, const CodegenOptions& options, Diagnostics& diagnostics,
      const Stop& stop = {}) = 0;
  std::shared_ptr<CompiledKernel> request(Program program, const CodegenOptions& options,
                                          Diagnostics& diagnostics);
  /// Returns at once. Higher priorities are compiled first.
  virtual std::shared_ptr<CompiledKernel> request_async(CodeRequest request,
                                                        const CodegenOptions& options,
                                                        int priority = 0) = 0;
  std::shared_ptr<CompiledKernel> request_async(Program program, const CodegenOptions& options,
                                                int priority = 0);
};

}  // namespace nacre
