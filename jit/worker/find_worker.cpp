#include <cstdlib>

#include "jit/worker/compiler.h"
#include "runtime/own_file.h"

namespace nacre {

std::filesystem::path find_worker() {
  if (const char* named = std::getenv("NACRE_COMPILE_WORKER"); named != nullptr) return named;
  return find_own_file({"libexec/nacre/nacre-compile-worker", "bin/nacre-compile-worker"});
}

}  // namespace nacre
