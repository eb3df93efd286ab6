#include "jit/worker/serve.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <new>

#include "jit/llvm/fatal.h"
#include "jit/worker/socket.h"
#include "runtime/program/digest.h"

namespace nacre {

namespace {

void give_up(const char* reason) {
  CompileAnswer answer;
  answer.fault = reason;
  send_frame(worker_socket, to_bytes(answer));
  std::_Exit(1);
}

void limit(__rlimit_resource resource, rlim_t most) {
  const rlimit both{most, most};
  (void)::setrlimit(resource, &both);
}

/// Bytes of address space that the process has: much, where a sanitizer keeps its own.
rlim_t taken() {
  unsigned long pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return rlim_t{pages} * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
}

/// LLVM recurses over deep expressions; threads of the library have as much for it.
void allow_deep_recursion() {
  constexpr rlim_t wanted = rlim_t{16} << 20;
  rlimit stack{};
  if (::getrlimit(RLIMIT_STACK, &stack) != 0 || stack.rlim_cur >= wanted) return;
  stack.rlim_cur = std::min(wanted, stack.rlim_max);
  (void)::setrlimit(RLIMIT_STACK, &stack);
}

}  // namespace

int serve_compiles(const Compile& compile, unsigned long megabytes) {
  limit(RLIMIT_CORE, 0);
  if (megabytes != 0) limit(RLIMIT_AS, taken() + (rlim_t{megabytes} << 20));
  allow_deep_recursion();
  on_llvm_fatal(give_up);
  while (const auto frame = receive_frame(worker_socket)) {
    const auto request = request_from_bytes(*frame);
    if (!request) give_up("the library and nacre-compile-worker are of different versions");
    // Should the host be gone by then, or stopped.
    ::alarm(static_cast<unsigned>(std::ceil(request->seconds)) + 1);
    CompileAnswer answer;
    try {
      answer.object = compile(*request, answer.diagnostics, answer.stats);
    } catch (const std::bad_alloc&) {
      std::_Exit(worker_out_of_memory);  // There may be no memory to say it in.
    }
    ::alarm(0);
    answer.digest = to_hex(code_digest(request->program));
    if (!send_frame(worker_socket, to_bytes(answer))) return 0;
  }
  return 0;
}

}  // namespace nacre
