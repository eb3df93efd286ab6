#include <dlfcn.h>

#include <array>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include "jit/worker/compiler.h"

namespace nacre {

namespace fs = std::filesystem;

fs::path find_worker() {
  if (const char* named = std::getenv("NACRE_COMPILE_WORKER"); named != nullptr) return named;
  Dl_info here{};
  if (::dladdr(reinterpret_cast<const void*>(&find_worker), &here) == 0) return {};
  std::error_code ignored;
  fs::path own = here.dli_fname;
  if (!own.is_absolute()) own = fs::read_symlink("/proc/self/exe", ignored);  // As it was called.
  const fs::path folder = fs::weakly_canonical(own, ignored).parent_path();
  // Beside it in a build; from bin, lib and lib/x86_64-linux-gnu where it is installed.
  constexpr std::array<std::string_view, 4> places{
      "nacre-compile-worker", "bin/nacre-compile-worker", "../libexec/nacre/nacre-compile-worker",
      "../../libexec/nacre/nacre-compile-worker"};
  for (const std::string_view place : places) {
    const fs::path path = (folder / place).lexically_normal();
    if (fs::is_regular_file(path, ignored)) return path;
  }
  return {};
}

}  // namespace nacre
