// A module that takes its time to be opened, and says when that has begun.
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "runtime/module.h"

namespace {

const bool opened = [] {
  if (const char* descriptor = std::getenv("NACRE_TEST_OPENING"); descriptor != nullptr) {
    if (::write(std::atoi(descriptor), "", 1) != 1) std::abort();
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  return true;
}();

}  // namespace

const nacre::ModuleHead* nacre_module() {
  static constexpr nacre::ModuleHead head{NACRE_BUILD_KEY, MODULE_NAME};
  return opened ? &head : nullptr;
}
