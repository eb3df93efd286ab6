#include "jit/service/compile_service.h"

#include <fmt/format.h>

#include <atomic>
#include <mutex>
#include <unordered_map>
#include <utility>

#include "jit/service/job.h"
#include "jit/service/service_kernel.h"
#include "jit/service/threads.h"
#include "runtime/interpreter/interpreter.h"
#include "runtime/process.h"
#include "runtime/process_end.h"
#include "runtime/program/recorder.h"
#include "runtime/report_stop.h"

namespace nacre {

namespace {

/// What compiles, in one process.
class Workshop {
 public:
  Workshop(const ServiceOptions& options, std::shared_ptr<JitSession> session,
           std::unique_ptr<Compiler> compiler, std::unique_ptr<KernelCache> cache,
           Diagnostics no_session)
      : options_(options),
        session_(std::move(session)),
        compiler_(std::move(compiler)),
        cache_(std::move(cache)),
        no_session_(std::move(no_session)),
        threads_(session_ == nullptr ? 1 : options.threads, options.executor) {}

  ~Workshop() {
    std::vector<std::shared_ptr<CompileJob>> jobs;
    {
      const std::scoped_lock lock(mutex_);
      for (const auto& [key, weak] : jobs_) {
        if (auto job = weak.lock()) jobs.push_back(std::move(job));
      }
    }
    // Without the lock: who is told may be a host.
    for (const std::shared_ptr<CompileJob>& job : jobs) job->give_up();
  }

  bool is_of_this_process() const { return process_.is_this(); }

  /// What a child of fork() has in its place. Reads only what no thread changes.
  std::unique_ptr<Workshop> heir() const {
    Diagnostics refused;
    std::shared_ptr<JitSession> session;
    // Whoever was cut off in LLVM may have held a lock of it, for ever now.
    if (session_ != nullptr && compiling_ != 0) {
      refused.warning("forked", {},
                      "kernels are interpreted, because the process forked while one was compiled");
    } else if (session_ != nullptr) {
      session = JitSession::create(options_.session, refused);
    } else {
      refused = no_session_;
    }
    auto made = std::make_unique<Workshop>(options_, std::move(session), compiler_->heir(),
                                           cache_ == nullptr ? nullptr : cache_->reopened(),
                                           std::move(refused));
    made->has_warned_ = session_ == nullptr;
    return made;
  }

  std::shared_ptr<CompiledKernel> find(const Program& program, const std::string& key,
                                       const CodegenOptions& options) {
    if (session_ == nullptr) return nullptr;
    std::shared_ptr<CompileJob> job = known_job(key);
    if (job == nullptr && cache_ != nullptr) job = cached_job(program, key, options);
    if (job != nullptr && job->entry() != nullptr && job->join()) {
      return std::make_shared<ServiceKernel>(std::make_shared<const Program>(program), options, job,
                                             nullptr);
    }
    if (job == nullptr) compiler_->prepare();
    return nullptr;
  }

  std::vector<std::shared_ptr<CompiledKernel>> request_all(std::vector<CodeRequest> requests,
                                                           const CodegenOptions& options,
                                                           Diagnostics& diagnostics,
                                                           const Stop& stop) {
    if (session_ == nullptr && !has_warned_.exchange(true)) {
      diagnostics.warning("no-jit", {}, "kernels are interpreted: " + no_session_.to_string());
    }
    std::vector<std::shared_ptr<CompiledKernel>> kernels;
    std::vector<std::shared_ptr<CompileJob>> jobs;
    for (auto& [program, key] : requests) {
      if (session_ == nullptr) {
        kernels.push_back(interpreting_kernel(std::move(program), options.max_steps, no_session_));
        continue;
      }
      auto shared = std::make_shared<const Program>(std::move(program));
      const std::shared_ptr<CompileJob> job =
          joined_job(key, shared, options, CompileThreads::awaited);
      kernels.push_back(std::make_shared<ServiceKernel>(shared, options, job, nullptr));
      jobs.push_back(job);
    }
    if (session_ == nullptr) return kernels;
    for (std::size_t i = 0; i < kernels.size(); ++i) {
      std::shared_ptr<CompiledKernel>& kernel = kernels[i];
      if (!jobs[i]->wait(stop)) {
        kernel = late_kernel(kernel->program(), options.max_steps, stop, diagnostics);
        continue;
      }
      const bool ready = kernel->wait();
      const Diagnostics said = kernel->diagnostics();
      for (const Diagnostic& one : said.all()) diagnostics.add(one);
      if (ready) continue;
      // Without an error it is the system that has no memory for code.
      kernel = said.has_errors() ? nullptr
                                 : interpreting_kernel(kernel->program(), options.max_steps, said);
    }
    return kernels;
  }

  std::shared_ptr<CompiledKernel> request_async(CodeRequest request, const CodegenOptions& options,
                                                int priority) {
    Program& program = request.program;
    if (session_ == nullptr) {  // Said when the service was made.
      return interpreting_kernel(std::move(program), options.max_steps, {});
    }
    auto interpreter = make_interpreter(program, options.max_steps);
    auto shared = std::make_shared<const Program>(std::move(program));
    const std::shared_ptr<CompileJob> job = joined_job(request.key, shared, options, priority);
    return std::make_shared<ServiceKernel>(shared, options, job, std::move(interpreter));
  }

 private:
  /// In the place of one whose code is not ready; nobody waits for that any more.
  static std::shared_ptr<CompiledKernel> late_kernel(const Program& program,
                                                     std::uint64_t max_steps, const Stop& stop,
                                                     Diagnostics& diagnostics) {
    if (stop.is_requested()) {
      report_if_due(stop, fmt::format("compiling '{}'", program.name), {}, diagnostics);
      return nullptr;
    }
    Diagnostics why;
    why.warning("compile-timeout", {},
                fmt::format("compiling '{}' takes too long, so it is interpreted", program.name),
                fmt::format("at most {} seconds", stop.seconds()));
    diagnostics.add(why.all().front());
    return interpreting_kernel(program, max_steps, std::move(why));
  }

  /// The job for this code, new and begun or one that is under way or done.
  std::shared_ptr<CompileJob> joined_job(const std::string& key,
                                         const std::shared_ptr<const Program>& program,
                                         const CodegenOptions& options, int priority) {
    std::shared_ptr<CompileJob> job;
    {
      const std::scoped_lock lock(mutex_);
      std::weak_ptr<CompileJob>& known = jobs_[key];
      job = known.lock();
      if (job != nullptr && job->join()) return job;
      job = shared_in_process(std::make_unique<CompileJob>(key, program, options));
      job->join();
      known = job;
      forget_dead();
    }
    threads_.add([this, job] { job->run(*session_, *compiler_, cache_.get(), compiling_); },
                 priority);
    return job;
  }

  /// One that is done, for the cache has what it would make.
  std::shared_ptr<CompileJob> cached_job(const Program& program, const std::string& key,
                                         const CodegenOptions& options) {
    auto job = shared_in_process(
        std::make_unique<CompileJob>(key, std::make_shared<const Program>(program), options));
    if (!job->find(*session_, *cache_)) return nullptr;
    const std::scoped_lock lock(mutex_);
    jobs_[key] = job;
    forget_dead();
    return job;
  }

  std::shared_ptr<CompileJob> known_job(const std::string& key) {
    const std::scoped_lock lock(mutex_);
    const auto known = jobs_.find(key);
    return known == jobs_.end() ? nullptr : known->second.lock();
  }

  /// Drops the keys of jobs that are gone, when they may be half of all.
  void forget_dead() {
    if (jobs_.size() < worth_cleaning_) return;
    std::erase_if(jobs_, [](const auto& entry) { return entry.second.expired(); });
    worth_cleaning_ = 2 * jobs_.size() + 64;
  }

  const Process process_;
  const ServiceOptions options_;
  const std::shared_ptr<JitSession> session_;  ///< Null where there is no JIT.
  const std::unique_ptr<Compiler> compiler_;
  const std::unique_ptr<KernelCache> cache_;
  const Diagnostics no_session_;         ///< Why there is no JIT.
  std::atomic<bool> has_warned_ = true;  ///< Of that.
  std::atomic<int> compiling_ = 0;       ///< Threads in LLVM, or about to be.
  std::mutex mutex_;
  std::unordered_map<std::string, std::weak_ptr<CompileJob>> jobs_;
  std::size_t worth_cleaning_ = 64;
  CompileThreads threads_;  ///< Last: ends before what it works with.
};

/// The workshop of this process: in a child of fork() a new one, made when it is needed.
class Service final : public CompileService {
 public:
  explicit Service(std::unique_ptr<Workshop> workshop) : workshop_(workshop.release()) {}

  /// In a child the threads that would have to end are not there.
  ~Service() override {
    Workshop* workshop = workshop_.load();
    if (workshop->is_of_this_process()) delete workshop;
  }

  std::shared_ptr<CompiledKernel> find(const Program& program, const std::string& key,
                                       const CodegenOptions& options) override {
    return workshop().find(program, key, options);
  }

  std::vector<std::shared_ptr<CompiledKernel>> request_all(std::vector<CodeRequest> requests,
                                                           const CodegenOptions& options,
                                                           Diagnostics& diagnostics,
                                                           const Stop& stop) override {
    return workshop().request_all(std::move(requests), options, diagnostics, stop);
  }

  std::shared_ptr<CompiledKernel> request_async(CodeRequest request, const CodegenOptions& options,
                                                int priority) override {
    return workshop().request_async(std::move(request), options, priority);
  }

 private:
  Workshop& workshop() {
    Workshop* known = workshop_.load();
    if (known->is_of_this_process()) return *known;
    std::unique_ptr<Workshop> made = known->heir();
    // Another thread of the child may have been first.
    return workshop_.compare_exchange_strong(known, made.get()) ? *made.release() : *known;
  }

  std::atomic<Workshop*> workshop_;
};

/// What requests look at and what is made once in a process (names of this build and this
/// CPU, OpenSSL's algorithms, the interpreter's operations) is made now: a child of fork()
/// would wait for ever for what another thread was about to make, and what threads make last goes
/// first when the process ends.
void make_what_is_made_once() {
  const Program nothing = Recorder().take();
  (void)code_key(nothing, CodegenOptions());
  (void)make_interpreter(nothing);
  (void)widest_lanes(Target::host());
  static const bool is_waited_for = (wait_for_work_at_exit(), true);
  (void)is_waited_for;
}

}  // namespace

std::unique_ptr<CompileService> CompileService::create(const ServiceOptions& options,
                                                       Diagnostics& diagnostics) {
  make_what_is_made_once();
  Diagnostics refused;
  std::shared_ptr<JitSession> session = JitSession::create(options.session, refused);
  if (session == nullptr) {
    diagnostics.warning("no-jit", {}, "kernels are interpreted: " + refused.to_string());
  }
  std::unique_ptr<Compiler> compiler =
      options.worker.empty() ? make_compiler_here()
                             : make_compiler_apart(options.worker, options.worker_limits);
  std::unique_ptr<KernelCache> cache;
  if (!options.cache.empty()) cache = KernelCache::open(options.cache, diagnostics);
  return std::make_unique<Service>(std::make_unique<Workshop>(
      options, std::move(session), std::move(compiler), std::move(cache), std::move(refused)));
}

std::shared_ptr<CompiledKernel> CompileService::request(Program program,
                                                        const CodegenOptions& options,
                                                        Diagnostics& diagnostics) {
  std::string key = code_key(program, options);
  std::vector<CodeRequest> requests;
  requests.push_back({std::move(program), std::move(key)});
  return request_all(std::move(requests), options, diagnostics).front();
}

std::shared_ptr<CompiledKernel> CompileService::request_async(Program program,
                                                              const CodegenOptions& options,
                                                              int priority) {
  std::string key = code_key(program, options);
  return request_async(CodeRequest{std::move(program), std::move(key)}, options, priority);
}

}  // namespace nacre
