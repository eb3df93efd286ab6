#include "examples/measure/kernel_cost.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <tuple>
#include <utility>

#include "examples/measure/sampler.h"
#include "jit/compile/compile.h"
#include "jit/llvm/code_map.h"

namespace nacre::measure {

namespace {

using Clock = std::chrono::steady_clock;
/// Function and origin of a Program.
using Part = std::pair<std::size_t, std::uint32_t>;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::map<Part, CostRow> rows_of(const Program& program) {
  std::map<Part, CostRow> rows;
  for (std::size_t f = 0; f < program.functions.size(); ++f) {
    for (const Instruction& instruction : program.functions[f].code) {
      if (instruction.op == Op::constant) continue;  // It is in the code that reads it.
      CostRow& row = rows[{f, instruction.origin}];
      row.function = f == 0 ? "" : program.functions[f].name;
      row.origin = program.origins[instruction.origin];
      ++row.operations;
    }
  }
  return rows;
}

}  // namespace

std::optional<KernelCost> measure_cost(const BoundKernel& kernel, Compiler& compiler,
                                       const CompileOptions& options, const Columns& given,
                                       double seconds, Diagnostics& diagnostics) {
  CodegenOptions codegen = codegen_options(options);
  codegen.line_tables = true;
  const Program& program = kernel.program();
  const auto session = JitSession::create({}, diagnostics);
  if (session == nullptr) return std::nullopt;
  CompileStats stats;
  const auto object = compiler.compile(program, codegen, diagnostics, stats, {});
  if (!object) return std::nullopt;
  const auto code = session->load(*object, diagnostics);
  if (code == nullptr) return std::nullopt;
  const CodeMap map(*object, code->entry());
  KernelRun run(kernel.with(make_jit_kernel(program, code, codegen.lanes, codegen.max_steps)),
                given);
  run();  // Pages, caches, and images that are read when they are first needed.

  KernelCost cost;
  cost.nanoseconds = nanoseconds_a_point(run, 0.25 * seconds);
  const std::vector<std::uintptr_t> samples = sample([&] {
    for (const Clock::time_point start = Clock::now(); seconds_since(start) < seconds;) run();
  });
  cost.samples = samples.size();
  cost.results = run.raw_results();
  const double each = samples.empty() ? 0 : cost.nanoseconds / static_cast<double>(samples.size());
  std::map<Part, CostRow> rows = rows_of(program);
  for (const std::uintptr_t address : samples) {
    const auto place = map.at(address);
    if (!place) {
      cost.other += each;
      continue;
    }
    const Instruction& instruction = program.functions[place->function].code[place->instruction];
    rows[{place->function, instruction.origin}].nanoseconds += each;
  }
  for (auto& [part, row] : rows) cost.rows.push_back(std::move(row));
  std::ranges::sort(cost.rows, [](const CostRow& a, const CostRow& b) {
    return std::tie(b.nanoseconds, b.operations, a.origin, a.function) <
           std::tie(a.nanoseconds, a.operations, b.origin, b.function);
  });
  return cost;
}

}  // namespace nacre::measure
