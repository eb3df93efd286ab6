#include "bench/accuracy/engine.h"

#include <utility>

#include "jit/llvm/codegen.h"
#include "jit/llvm/session.h"
#include "runtime/diagnostic.h"
#include "runtime/interpreter/interpreter.h"

namespace nacre {

namespace {

std::shared_ptr<const Kernel> make_jit(Program program, Accuracy accuracy,
                                       Diagnostics& diagnostics) {
  CodegenOptions options;
  options.accuracy = accuracy;
  const auto session = JitSession::create({}, diagnostics);
  const auto object = compile_object(program, options, diagnostics);
  if (!session || !object) return nullptr;
  auto code = session->load(*object, diagnostics);
  if (!code) return nullptr;
  return make_jit_kernel(std::move(program), std::move(code), options.lanes);
}

}  // namespace

std::shared_ptr<const Kernel> make_kernel(Program program, Engine engine, Accuracy accuracy,
                                          std::string& error) {
  if (engine == Engine::interpreter) return make_interpreter(std::move(program));
  Diagnostics diagnostics;
  auto kernel = make_jit(std::move(program), accuracy, diagnostics);
  if (!kernel) error = diagnostics.to_string();
  return kernel;
}

}  // namespace nacre
