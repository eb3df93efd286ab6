#include "jit/service/threads.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "runtime/float_environment.h"

namespace nacre {

namespace {

/// LLVM recurses over deep expressions; pages not used cost nothing.
constexpr std::size_t stack_bytes = 16u << 20;

}  // namespace

CompileThreads::CompileThreads(int count) {
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  count = count <= 0 ? cores : std::min(count, std::max(64, 4 * cores));
  threads_.reserve(static_cast<std::size_t>(count));
  pthread_attr_t attributes;
  if (pthread_attr_init(&attributes) != 0) return;
  pthread_attr_setstacksize(&attributes, stack_bytes);
  for (int k = 0; k < count; ++k) {
    pthread_t thread;
    if (pthread_create(&thread, &attributes, &enter, this) != 0) break;
    threads_.push_back(thread);
  }
  pthread_attr_destroy(&attributes);
}

CompileThreads::~CompileThreads() {
  {
    const std::scoped_lock lock(mutex_);
    ending_ = true;
    tasks_.clear();
  }
  changed_.notify_all();
  for (const pthread_t thread : threads_) pthread_join(thread, nullptr);
}

void CompileThreads::add(std::function<void()> task, bool urgent) {
  if (threads_.empty()) return task();
  {
    const std::scoped_lock lock(mutex_);
    if (urgent) {
      tasks_.push_front(std::move(task));
    } else {
      tasks_.push_back(std::move(task));
    }
  }
  changed_.notify_one();
}

void* CompileThreads::enter(void* self) {
  static_cast<CompileThreads*>(self)->work();
  return nullptr;
}

void CompileThreads::work() {
  // A thread begins in the environment of the one that made it.
  const ScopedDefaultFloatEnvironment environment;
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return ending_ || !tasks_.empty(); });
    if (ending_) return;
    const std::function<void()> task = std::move(tasks_.front());
    tasks_.pop_front();
    lock.unlock();
    task();
    lock.lock();
  }
}

}  // namespace nacre
