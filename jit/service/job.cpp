#include "jit/service/job.h"

#include <chrono>
#include <new>
#include <utility>

#include "runtime/program/digest.h"

namespace nacre {

namespace {

/// Adds the time that f takes to `seconds`.
template <class F>
auto timed(double& seconds, F&& f) {
  const auto start = std::chrono::steady_clock::now();
  auto result = f();
  seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace

bool CompileJob::join() {
  const std::scoped_lock lock(mutex_);
  if (state_ == State::cancelled || state_ == State::failed) return false;
  ++interested_;
  return true;
}

void CompileJob::leave() {
  if (!process_.is_this()) return;
  {
    const std::scoped_lock lock(mutex_);
    if (--interested_ > 0 || state_ != State::waiting) return;
    state_ = State::cancelled;
  }
  // Calls of when_ended() are left to a thread that compiles: hosts may leave with locks held.
  ended_.notify_all();
}

bool CompileJob::unwanted() {
  {
    const std::scoped_lock lock(mutex_);
    if (state_ == State::waiting) return false;
  }
  tell();
  return true;
}

void CompileJob::tell() {
  ended_.notify_all();
  std::vector<std::function<void()>> calls;
  {
    const std::scoped_lock lock(mutex_);
    calls.swap(calls_);
  }
  for (const std::function<void()>& call : calls) call();
}

void CompileJob::when_ended(std::function<void()> call) {
  if (process_.is_this()) {
    const std::scoped_lock lock(mutex_);
    if (state_ == State::waiting) {
      calls_.push_back(std::move(call));
      return;
    }
  }
  call();
}

bool CompileJob::find(JitSession& session, KernelCache& cache) {
  Diagnostics said;
  CompileStats stats;
  auto code = load_cached(session, cache, said, stats);
  const bool is_there = code != nullptr;
  if (is_there) end_with(std::move(code), stats, std::move(said));
  return is_there;
}

void CompileJob::run(JitSession& session, Compiler& compiler, KernelCache* cache,
                     std::atomic<int>& compiling) {
  Diagnostics said;
  CompileStats stats;
  std::shared_ptr<const LoadedCode> code;
  ++compiling;
  try {
    code = make(session, compiler, cache, said, stats);
  } catch (const std::bad_alloc&) {
    said.error("out-of-memory", {}, "can't compile a kernel: memory is short", {}, program_->name);
  }
  --compiling;
  end_with(std::move(code), stats, std::move(said));
}

void CompileJob::end_with(std::shared_ptr<const LoadedCode> code, const CompileStats& stats,
                          Diagnostics said) {
  {
    const std::scoped_lock lock(mutex_);
    if (state_ == State::waiting) {
      state_ = code != nullptr ? State::ready : State::failed;
      code_ = std::move(code);
      stats_ = stats;
      diagnostics_ = std::move(said);
      if (code_ != nullptr) entry_.store(code_->entry(), std::memory_order_release);
    }
  }
  tell();
}

std::shared_ptr<const LoadedCode> CompileJob::load_cached(JitSession& session, KernelCache& cache,
                                                          Diagnostics& said, CompileStats& stats) {
  const auto found =
      timed(stats.cache, [&] { return cache.load(key_, interface_text(*program_), said); });
  if (!found) return nullptr;
  Diagnostics unsound;  // Then it is compiled, which says what there is to say.
  stats.object_bytes = found->bytes.size();
  stats.from_cache = true;
  auto code = timed(stats.link, [&] { return session.load(*found, unsound); });
  if (code == nullptr) stats = {};
  return code;
}

std::shared_ptr<const LoadedCode> CompileJob::make(JitSession& session, Compiler& compiler,
                                                   KernelCache* cache, Diagnostics& said,
                                                   CompileStats& stats) {
  if (unwanted()) return nullptr;
  if (cache != nullptr) {
    if (auto code = load_cached(session, *cache, said, stats)) return code;
  }
  const auto object = compile(compiler, cache, said, stats);
  if (!object || unwanted()) return nullptr;
  return timed(stats.link, [&] { return session.load(*object, said); });
}

std::optional<ObjectCode> CompileJob::compile(Compiler& compiler, KernelCache* cache,
                                              Diagnostics& said, CompileStats& stats) {
  auto object = compiler.compile(*program_, options_, said, stats, [this] { return unwanted(); });
  if (object && cache != nullptr) {
    timed(stats.cache, [&] {
      cache->store(key_, *object, said);
      return true;
    });
  }
  return object;
}

void CompileJob::give_up() {
  {
    const std::scoped_lock lock(mutex_);
    if (state_ != State::waiting && state_ != State::cancelled) return;
    state_ = State::cancelled;
  }
  tell();
}

bool CompileJob::wait() const {
  if (!process_.is_this()) return entry() != nullptr;
  std::unique_lock lock(mutex_);
  ended_.wait(lock, [this] { return state_ != State::waiting; });
  return state_ == State::ready;
}

bool CompileJob::wait(const Stop& stop) const {
  std::unique_lock lock(mutex_);
  const auto has_ended = [this] { return state_ != State::waiting; };
  return ended_.wait_until(lock, stop.token(), stop.deadline(), has_ended);
}

CompileJob::State CompileJob::state() const {
  if (!process_.is_this()) return entry() != nullptr ? State::ready : State::cancelled;
  const std::scoped_lock lock(mutex_);
  return state_;
}

std::string_view CompileJob::fits() const {
  // Where the entry is there, so is the code, for good: no lock, which a child of fork() may not
  // take.
  return entry() != nullptr ? code_->fits() : std::string_view();
}

CompileStats CompileJob::stats() const {
  if (!process_.is_this()) return {};
  const std::scoped_lock lock(mutex_);
  return stats_;
}

Diagnostics CompileJob::diagnostics() const {
  if (!process_.is_this()) {
    Diagnostics said;
    if (entry() == nullptr) {
      said.warning("forked", {},
                   "a kernel is interpreted, because it was being compiled when the process forked",
                   {}, program_->name);
    }
    return said;
  }
  const std::scoped_lock lock(mutex_);
  return diagnostics_;
}

}  // namespace nacre
