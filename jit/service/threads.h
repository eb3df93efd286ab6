#pragma once

#include <pthread.h>

#include <functional>
#include <limits>
#include <memory>
#include <vector>

namespace nacre {

/// Threads of a host's, which run what they are given, soon and in any order.
class Executor {
 public:
  virtual ~Executor() = default;
  virtual void submit(std::function<void()> task) = 0;
};

/// Who runs the tasks that compile: threads with stacks large enough for LLVM, whatever the host's
/// limits are, which std::thread can't choose; or the host's own. Higher priorities go first, equal
/// ones in order of arrival.
class CompileThreads {
 public:
  /// `count` 0: one a core; never more than 64, or four a core. Threads that can't be had
  /// are done without; with none at all, add() runs the task itself. With an `executor` there are
  /// none of ours.
  explicit CompileThreads(int count, std::shared_ptr<Executor> executor = nullptr);
  /// Ends the running tasks, drops the others.
  ~CompileThreads();
  CompileThreads(const CompileThreads&) = delete;
  CompileThreads& operator=(const CompileThreads&) = delete;

  /// Of what somebody waits for: the highest.
  static constexpr int awaited = std::numeric_limits<int>::max();

  void add(std::function<void()> task, int priority);

 private:
  class Queue;
  static void* enter(void* queue);

  std::shared_ptr<Executor> executor_;
  std::shared_ptr<Queue> queue_;  ///< What was submitted may still come when this is gone.
  std::vector<pthread_t> threads_;
};

}  // namespace nacre
