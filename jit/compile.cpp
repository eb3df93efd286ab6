#include "jit/compile.h"

#include <cassert>
#include <chrono>
#include <utility>

#include "jit/llvm/codegen.h"
#include "jit/passes/contract.h"
#include "jit/passes/derive.h"
#include "jit/passes/expand_math.h"
#include "jit/service/compile_service.h"
#include "runtime/interpreter/interpreter.h"
#include "runtime/reference/reference.h"

namespace nacre {

namespace {

/// Runs one stage: timed, reported and, in debug builds, verified afterwards.
class Stages {
 public:
  Stages(std::vector<StageReport>* reports, bool keep_text)
      : reports_(reports), keep_text_(keep_text) {}

  template <class Pass>
  Program run(const char* name, const Program& program, Pass&& pass) {
    const auto start = std::chrono::steady_clock::now();
    Program result = pass(program);
    assert(verify(result).empty());
    if (reports_ != nullptr) {
      const std::chrono::duration<double, std::milli> elapsed =
          std::chrono::steady_clock::now() - start;
      StageReport report;
      report.name = name;
      report.milliseconds = elapsed.count();
      for (const Function& function : result.functions) report.instructions += function.code.size();
      if (keep_text_) report.text = to_string(result);
      reports_->push_back(std::move(report));
    }
    return result;
  }

 private:
  std::vector<StageReport>* reports_;
  bool keep_text_;
};

}  // namespace

Program lower(Program program, const CompileOptions& options, std::vector<StageReport>* reports) {
  Stages stages(reports, options.keep_text);
  program = stages.run("recorded", program, [](const Program& p) { return p; });

  // Footprint derivatives become arithmetic on derivative channels.
  program = stages.run("derive", program, [](const Program& p) { return derive(p); });

  // The oracle computes what was written: no contraction, functions of the C library.
  if (options.backend == Backend::reference) return program;

  // a * b + c in one rounding; precise rounds as the node's body says.
  if (options.accuracy != Accuracy::precise) {
    program = stages.run("contract", program, [](const Program& p) { return contract(p); });
  }

  // Transcendental functions become polynomials of the accuracy asked for.
  program = stages.run("expand_math", program, [&](const Program& p) {
    return expand_math(p, options.accuracy);
  });

  mark_varying(program, options.all_varying);
  return program;
}

std::shared_ptr<const Kernel> compile(Program program, const CompileOptions& options,
                                      CompileService* service, Diagnostics& diagnostics,
                                      std::vector<StageReport>* stages) {
  program = lower(std::move(program), options, stages);
  switch (options.backend) {
    case Backend::reference: return make_reference(std::move(program));
    case Backend::interpreter: return make_interpreter(std::move(program));
    case Backend::jit: break;
  }
  assert(service != nullptr);
  const auto dump = [&](bool wanted, const char* name, auto&& text_of) {
    if (!wanted || stages == nullptr) return;
    StageReport report;
    report.name = name;
    report.text = text_of(program, codegen_options(options), diagnostics);
    stages->push_back(std::move(report));
  };
  dump(options.dump_ir, "llvm", [](auto&&... x) { return nacre::dump_ir(x...); });
  dump(options.dump_assembly, "assembly", [](auto&&... x) { return nacre::dump_assembly(x...); });
  return service->compile(std::move(program), options, diagnostics);
}

}  // namespace nacre
