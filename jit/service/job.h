#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "jit/cache/kernel_cache.h"
#include "jit/service/compile_service.h"
#include "runtime/process.h"
#include "runtime/stop.h"

namespace nacre {

/// The making of one piece of code, and the code. Shared by all kernels of equal
/// Programs and options. In a child of fork(), what was not ready by then never will be.
class CompileJob {
 public:
  using State = CompiledKernel::State;

  CompileJob(std::string key, std::shared_ptr<const Program> program, CodegenOptions options)
      : key_(std::move(key)), program_(std::move(program)), options_(std::move(options)) {}

  const std::string& key() const { return key_; }

  /// One more waits for the code. False if the job was given up or has failed.
  bool join();
  /// One less does. Without any, the job is given up.
  void leave();

  /// Takes the code from the cache, if it is there. Before anybody else knows of the job.
  bool find(JitSession& session, KernelCache& cache);
  /// Cache, or compiler and cache; then the linker. Sets the state. `compiling` counts while
  /// that goes on.
  void run(JitSession& session, Compiler& compiler, KernelCache* cache,
           std::atomic<int>& compiling);
  /// Ends it without code, if it has not ended; running, it stops at the next stage.
  void give_up();
  bool wait() const;
  /// False if it has not ended when `stop` is due.
  bool wait(const Stop& stop) const;

  /// Calls once when it has ended; at once if it has.
  void when_ended(std::function<void()> call);

  State state() const;
  /// The code to run, or null. Once not null it stays the same.
  LoadedCode::Entry entry() const { return entry_.load(std::memory_order_acquire); }
  /// LoadedCode::fits() of it; empty where there is none.
  std::string_view fits() const;
  CompileStats stats() const;
  Diagnostics diagnostics() const;

 private:
  std::optional<ObjectCode> compile(Compiler& compiler, KernelCache* cache, Diagnostics& said,
                                    CompileStats& stats);
  std::shared_ptr<const LoadedCode> load_cached(JitSession& session, KernelCache& cache,
                                                Diagnostics& said, CompileStats& stats);
  void end_with(std::shared_ptr<const LoadedCode> code, const CompileStats& stats,
                Diagnostics said);
  std::shared_ptr<const LoadedCode> make(JitSession& session, Compiler& compiler,
                                         KernelCache* cache, Diagnostics& said,
                                         CompileStats& stats);
  /// Whether it was given up, because nobody waits for it.
  bool unwanted();
  /// Tells everybody. Not under the lock.
  void tell();

  const std::string key_;
  const std::shared_ptr<const Program> program_;
  const CodegenOptions options_;
  const Process process_;
  std::atomic<LoadedCode::Entry> entry_ = nullptr;

  mutable std::mutex mutex_;
  mutable std::condition_variable_any ended_;
  State state_ = State::waiting;
  int interested_ = 0;                        ///< Kernels that were not cancelled.
  std::vector<std::function<void()>> calls_;  ///< Of when_ended.
  std::shared_ptr<const LoadedCode> code_;
  CompileStats stats_;
  Diagnostics diagnostics_;
};

}  // namespace nacre
