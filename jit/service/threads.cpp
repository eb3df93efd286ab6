#include "jit/service/threads.h"

#include <algorithm>
#include <condition_variable>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include "runtime/float_environment.h"
#include "runtime/process_end.h"

namespace nacre {

namespace {

/// LLVM recurses over deep expressions; pages not used cost nothing.
constexpr std::size_t stack_bytes = 16u << 20;

}  // namespace

/// What is to be done, and who is doing it.
class CompileThreads::Queue {
 public:
  void add(std::function<void()> task, int priority) {
    {
      const std::scoped_lock lock(mutex_);
      tasks_.emplace(priority, std::move(task));  // Behind those of its priority.
    }
    changed_.notify_one();
  }

  /// One task after another, until the end.
  void run_all() {
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [this] { return ending_ || !tasks_.empty(); });
      if (ending_) return;
      run_first(lock);
    }
  }

  /// The first, if there is one.
  void run_one() {
    std::unique_lock lock(mutex_);
    if (!tasks_.empty()) run_first(lock);
  }

  /// From now on nothing begins; returns when nothing is running.
  void end() {
    std::unique_lock lock(mutex_);
    ending_ = true;
    tasks_.clear();
    changed_.notify_all();
    changed_.wait(lock, [this] { return running_ == 0; });
  }

 private:
  void run_first(std::unique_lock<std::mutex>& lock) {
    const std::function<void()> task = std::move(tasks_.begin()->second);
    tasks_.erase(tasks_.begin());
    ++running_;
    lock.unlock();
    if (const AtWork process; process) task();
    lock.lock();
    --running_;
    if (ending_) changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::multimap<int, std::function<void()>, std::greater<>> tasks_;  ///< By priority.
  int running_ = 0;
  bool ending_ = false;
};

CompileThreads::CompileThreads(int count, std::shared_ptr<Executor> executor)
    : executor_(std::move(executor)), queue_(std::make_shared<Queue>()) {
  if (executor_ != nullptr) return;
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  count = count <= 0 ? cores : std::min(count, std::max(64, 4 * cores));
  threads_.reserve(static_cast<std::size_t>(count));
  pthread_attr_t attributes;
  if (pthread_attr_init(&attributes) != 0) return;
  pthread_attr_setstacksize(&attributes, stack_bytes);
  for (int k = 0; k < count; ++k) {
    pthread_t thread;
    if (pthread_create(&thread, &attributes, &enter, queue_.get()) != 0) break;
    threads_.push_back(thread);
  }
  pthread_attr_destroy(&attributes);
}

CompileThreads::~CompileThreads() {
  queue_->end();
  for (const pthread_t thread : threads_) pthread_join(thread, nullptr);
}

void CompileThreads::add(std::function<void()> task, int priority) {
  if (executor_ == nullptr && threads_.empty()) return task();
  queue_->add(std::move(task), priority);
  if (executor_ == nullptr) return;
  executor_->submit([queue = queue_] {
    const ScopedDefaultFloatEnvironment environment;
    queue->run_one();
  });
}

void* CompileThreads::enter(void* queue) {
  // A thread begins in the environment of the one that made it.
  const ScopedDefaultFloatEnvironment environment;
  static_cast<Queue*>(queue)->run_all();
  return nullptr;
}

}  // namespace nacre
