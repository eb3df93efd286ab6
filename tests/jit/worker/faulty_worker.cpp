// nacre-compile-worker in which the Program's name says what goes wrong.

#include <llvm/Support/ErrorHandling.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <string>
#include <vector>

#include "jit/worker/serve.h"

namespace {

using namespace nacre;

void fail(const std::string& how) {
  if (how == "fatal") llvm::report_fatal_error("cannot select what was asked for");
  if (how == "crash") std::raise(SIGSEGV);
  if (how == "hang") {
    while (true) ::pause();
  }
  if (how == "memory") {
    std::vector<std::vector<char>> all;
    while (true) all.emplace_back(std::size_t{64} << 20);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const auto compile = [](const CompileRequest& request, Diagnostics& diagnostics,
                          CompileStats& stats) {
    fail(request.program.name);
    auto object = compile_object(request.program, request.options, diagnostics, &stats);
    if (request.program.name == "another") object->interface += " and more";
    return object;
  };
  return serve_compiles(compile, argc == 2 ? std::strtoul(argv[1], nullptr, 10) : 0);
}
