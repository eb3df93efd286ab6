#pragma once

namespace nacre {

/// The process ends while threads of ours compile, if its host calls exit() or returns from main()
/// with a System that lives on: static objects then go one after the other, what was made last
/// first, LLVM's tables and ours under whoever still reads them. Who works on such a thread holds
/// one of these, and the process waits for it; where it has none, the process is ending and there
/// is nothing to be done any more.
class AtWork {
 public:
  AtWork();
  ~AtWork();
  AtWork(const AtWork&) = delete;
  AtWork& operator=(const AtWork&) = delete;

  explicit operator bool() const { return may_work_; }

 private:
  bool may_work_;
};

/// Has the end of the process wait for all who are at work, before it destroys any static object
/// that exists now: to be called, once or more often, when what they read has been made. A child
/// of fork() waits for none of its parent's threads, and a thread at work that ends the process
/// does not wait for itself.
void wait_for_work_at_exit();

}  // namespace nacre
