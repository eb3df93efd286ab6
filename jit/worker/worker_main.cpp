// nacre-compile-worker: compiles Programs for a host, so that what ends or hangs in LLVM
// ends a process that nobody misses. Started by the library, with the megabytes that it may
// take; see message.h.
#include <cstdlib>

#include "jit/worker/serve.h"

int main(int argc, char** argv) {
  using namespace nacre;
  const unsigned long megabytes = argc == 2 ? std::strtoul(argv[1], nullptr, 10) : 0;
  const auto compile = [](const CompileRequest& request, Diagnostics& diagnostics,
                          CompileStats& stats) {
    return compile_object(request.program, request.options, diagnostics, &stats);
  };
  return serve_compiles(compile, megabytes);
}
