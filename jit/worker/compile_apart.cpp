#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <utility>
#include <vector>

#include "jit/worker/compiler.h"
#include "jit/worker/message.h"
#include "jit/worker/worker_process.h"
#include "runtime/process.h"
#include "runtime/program/digest.h"

namespace nacre {

namespace {

using Clock = std::chrono::steady_clock;

class CompilerApart final : public Compiler {
 public:
  CompilerApart(std::filesystem::path program, const WorkerLimits& limits)
      : program_(std::move(program)), limits_(limits) {}

  ~CompilerApart() override {
    if (process_.is_this()) return;
    for (const std::unique_ptr<WorkerProcess>& worker : idle_) worker->forget();
  }

  /// Starts the first, to load LLVM while the host does other things; a fault is said once
  /// it is wanted.
  void prepare() override {
    if (has_begun_.exchange(true)) return;
    std::string fault;
    if (auto first = WorkerProcess::start(program_, limits_, fault)) give_back(std::move(first));
  }

  std::unique_ptr<Compiler> heir() const override {
    return std::make_unique<CompilerApart>(program_, limits_);
  }

  std::optional<ObjectCode> compile(const Program& program, const CodegenOptions& options,
                                    Diagnostics& diagnostics, CompileStats& stats,
                                    const std::function<bool()>& cancelled) override {
    std::string fault;
    has_begun_ = true;
    std::unique_ptr<WorkerProcess> worker = take(fault);
    if (worker == nullptr) return failed(program, "it cannot be started", fault, diagnostics);
    const std::string request = to_bytes(CompileRequest{options, program, limits_.seconds});
    const Clock::time_point begun = Clock::now();
    bool is_late = false;
    bool is_unwanted = false;
    const auto bytes = worker->ask(request, [&] {
      is_late = Clock::now() - begun > std::chrono::duration<double>(limits_.seconds);
      is_unwanted = cancelled && cancelled();
      return is_late || is_unwanted;
    });
    if (is_unwanted) return std::nullopt;
    if (is_late) {
      return failed(program, "it takes too long", fmt::format("{} seconds", limits_.seconds),
                    diagnostics);
    }
    if (!bytes) return failed(program, worker->how_it_ended(), {}, diagnostics);
    auto answer = answer_from_bytes(*bytes);
    if (!answer) return failed(program, "its answer makes no sense", {}, diagnostics);
    if (!answer->fault.empty()) return failed(program, "LLVM gave up", answer->fault, diagnostics);
    for (const Diagnostic& one : answer->diagnostics.all()) diagnostics.add(one);
    if (answer->object && !is_of(*answer, program, options)) {
      return failed(program, "its answer is to something else", {}, diagnostics);
    }
    stats = answer->stats;
    give_back(std::move(worker));
    return std::move(answer->object);
  }

 private:
  std::unique_ptr<WorkerProcess> take(std::string& fault) {
    {
      const std::scoped_lock lock(mutex_);
      if (!idle_.empty()) {
        std::unique_ptr<WorkerProcess> worker = std::move(idle_.back());
        idle_.pop_back();
        return worker;
      }
    }
    return WorkerProcess::start(program_, limits_, fault);
  }

  void give_back(std::unique_ptr<WorkerProcess> worker) {
    const std::scoped_lock lock(mutex_);
    idle_.push_back(std::move(worker));
  }

  /// What a cached object has to be, too.
  static bool is_of(const CompileAnswer& answer, const Program& program,
                    const CodegenOptions& options) {
    return answer.digest == to_hex(code_digest(program)) &&
           answer.object->symbol == entry_symbol(program, options) &&
           answer.object->interface == interface_text(program);
  }

  static std::optional<ObjectCode> failed(const Program& program, const std::string& what,
                                          const std::string& found, Diagnostics& diagnostics) {
    diagnostics.warning(
        "compile-failed", {},
        fmt::format("the kernel '{}' is interpreted: of the process that compiles, {}",
                    program.name, what),
        {}, found);
    return std::nullopt;
  }

  const Process process_;
  const std::filesystem::path program_;
  const WorkerLimits limits_;
  std::atomic<bool> has_begun_ = false;
  std::mutex mutex_;
  std::vector<std::unique_ptr<WorkerProcess>> idle_;  ///< The latest last.
};

}  // namespace

std::unique_ptr<Compiler> make_compiler_apart(std::filesystem::path program,
                                              const WorkerLimits& limits) {
  return std::make_unique<CompilerApart>(std::move(program), limits);
}

}  // namespace nacre
