#pragma once

#include <pthread.h>

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <vector>

namespace nacre {

/// Threads with stacks large enough for LLVM, whatever the host's limits are;
/// std::thread can't choose. Tasks run in order of arrival, urgent ones first.
class CompileThreads {
 public:
  /// `count` 0: one a core; never more than 64, or four a core. Threads that can't be had
  /// are done without; with none at all, add() runs the task itself.
  explicit CompileThreads(int count);
  /// Ends the running tasks, drops the others.
  ~CompileThreads();
  CompileThreads(const CompileThreads&) = delete;
  CompileThreads& operator=(const CompileThreads&) = delete;

  void add(std::function<void()> task, bool urgent);

 private:
  static void* enter(void* self);
  void work();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> tasks_;
  bool ending_ = false;
  std::vector<pthread_t> threads_;
};

}  // namespace nacre
