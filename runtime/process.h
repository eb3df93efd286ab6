#pragma once

#include <unistd.h>

#include <memory>
#include <utility>

namespace nacre {

/// Remembers the process that it was made in. A child of fork() has but the thread that
/// called it: a lock that another thread held is held for ever, and who waits for another
/// waits for ever. So a child neither uses nor destroys what threads share.
class Process {
 public:
  bool is_this() const { return getpid() == id_; }

 private:
  pid_t id_ = getpid();
};

/// Shares an object between threads; a child of fork() leaves it where it is.
template <class T>
std::shared_ptr<T> shared_in_process(std::unique_ptr<T> object) {
  return std::shared_ptr<T>(object.release(), [made = Process()](T* pointer) {
    if (made.is_this()) delete pointer;
  });
}

}  // namespace nacre
