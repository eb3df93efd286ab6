#include "jit/compile/lower.h"

#include <cassert>
#include <utility>

#include "jit/compile/stages.h"
#include "jit/passes/contract.h"
#include "jit/passes/derive.h"
#include "jit/passes/expand_math.h"
#include "jit/passes/flatten.h"
#include "runtime/float_environment.h"

namespace nacre {

bool is_too_large(const Program& program, const CompileOptions& options) {
  return instruction_count(program) > options.max_instructions;
}

Program lower(Program program, const CompileOptions& options, std::vector<StageReport>* reports) {
  const ScopedDefaultFloatEnvironment environment;
  Stages stages(reports);
  const auto is_over = [&] { return is_too_large(program, options) || options.stop.is_due(); };
  const auto describe = [&](const Program& made, StageReport& report) {
    report.instructions = instruction_count(made);
    if (options.keep_text && !is_too_large(made, options)) report.text = to_string(made);
  };
  const auto run = [&](const char* name, const auto& pass) {
    program = stages.run(name, [&] { return pass(program); }, describe);
    assert(is_too_large(program, options) || verify(program).empty());
  };
  run("slice", [](const Program& p) { return p; });
  if (is_over()) return program;

  // What costs less than a branch is computed for all lanes.
  run("flatten", [&](const Program& p) { return flatten_regions(p, options.max_instructions); });
  if (is_over()) return program;

  // Footprint derivatives become arithmetic on derivative channels.
  run("derive", [&](const Program& p) { return derive(p, {}, options.max_instructions); });
  if (is_over()) return program;

  // The oracle computes what was written: no contraction, functions of the C library.
  if (options.backend == Backend::reference) return program;

  // a * b + c in one rounding; precise rounds as the node's body says.
  if (options.accuracy != Accuracy::precise) {
    run("contract", [](const Program& p) { return contract(p); });
    if (is_over()) return program;
  }

  // Transcendental functions become polynomials of the accuracy asked for.
  run("expand_math",
      [&](const Program& p) { return expand_math(p, options.accuracy, options.max_instructions); });
  if (is_over()) return program;

  mark_varying(program, options.all_varying);
  return program;
}

}  // namespace nacre
