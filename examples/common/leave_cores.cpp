#include "examples/common/leave_cores.h"

#include <chrono>
#include <thread>

namespace nacre::host {

void leave_cores(int index, int threads, const std::function<int()>& pending,
                 const std::function<bool()>& has_ended) {
  while (index > 0 && pending() >= threads - index && !has_ended()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

}  // namespace nacre::host
