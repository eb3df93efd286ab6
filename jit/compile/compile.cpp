#include "jit/compile/compile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <utility>

#include "jit/compile/lower.h"
#include "jit/llvm/codegen.h"
#include "jit/service/compile_service.h"
#include "runtime/float_environment.h"
#include "runtime/interpreter/interpreter.h"
#include "runtime/reference/reference.h"
#include "runtime/report_stop.h"

namespace nacre {

namespace {

/// Whether a pass takes too long even if every loop runs one round.
bool is_too_slow(const Program& program, const CompileOptions& options, Diagnostics& diagnostics) {
  const double steps = function_costs(program).front().once;
  if (steps <= static_cast<double>(options.max_steps)) return false;
  diagnostics.error("too-many-steps", {},
                    fmt::format("the kernel '{}' takes too long for each point", program.name),
                    fmt::format("at most {} steps", options.max_steps),
                    fmt::format("{:.3g}", steps));
  return true;
}

/// Reports and drops the Programs that are too large or too slow; which of them are left.
std::vector<bool> refuse_excess(std::vector<Program>& programs, const CompileOptions& options,
                                Diagnostics& diagnostics) {
  std::vector<bool> fits;
  for (const Program& program : programs) {
    fits.push_back(!is_too_large(program, options));
    if (fits.back()) {
      fits.back() = !is_too_slow(program, options, diagnostics);
      continue;
    }
    diagnostics.error("program-too-large", {},
                      fmt::format("the kernel '{}' is too large", program.name),
                      fmt::format("at most {} instructions", options.max_instructions),
                      fmt::format("{}", instruction_count(program)));
  }
  std::size_t i = 0;
  std::erase_if(programs, [&](const Program&) { return !fits[i++]; });
  return fits;
}

/// Null where a Program was refused.
std::vector<std::shared_ptr<const Kernel>> in_their_places(
    std::vector<std::shared_ptr<const Kernel>> kernels, const std::vector<bool>& fits) {
  std::vector<std::shared_ptr<const Kernel>> all(fits.size());
  std::size_t next = 0;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (fits[i]) all[i] = std::move(kernels[next++]);
  }
  return all;
}

std::vector<std::shared_ptr<const Kernel>> make_machine_code(std::vector<Program> programs,
                                                             const CompileOptions& options,
                                                             CompileService& service,
                                                             Diagnostics& diagnostics) {
  const CodegenOptions codegen = codegen_options(options);
  if (!options.asynchronous) {
    auto kernels = service.request_all(std::move(programs), codegen, diagnostics,
                                       options.stop.within(options.max_seconds));
    return {kernels.begin(), kernels.end()};
  }
  std::vector<std::shared_ptr<const Kernel>> kernels;
  for (Program& program : programs) {
    kernels.push_back(service.request_async(std::move(program), codegen));
  }
  return kernels;
}

}  // namespace

Stop stop_from_now(const CompileOptions& options) {
  // Somebody who would rather interpret than wait has a small max_seconds.
  return options.stop.within(std::max(options.max_seconds, 1.0));
}

CodegenOptions codegen_options(const CompileOptions& options) {
  CodegenOptions made;
  made.accuracy = options.accuracy;
  made.lanes = options.lanes != 0 ? options.lanes : widest_lanes(made.target);
  made.max_steps = options.max_steps;
  return made;
}

std::vector<std::shared_ptr<const Kernel>> compile_all(
    std::vector<Program> programs, const CompileOptions& asked, CompileService* service,
    Diagnostics& diagnostics, std::vector<std::vector<StageReport>>* stages) {
  CompileOptions options = asked;
  options.stop = stop_from_now(asked);
  const ScopedDefaultFloatEnvironment environment;
  if (stages != nullptr) stages->resize(programs.size());
  if (options.lanes != 0 && !is_lane_count(options.lanes)) {
    diagnostics.error("bad-lanes", {}, "there is no code of so many lanes",
                      "1, 4, 8 or 16, or 0 for the widest that pays",
                      fmt::format("{}", options.lanes));
    return std::vector<std::shared_ptr<const Kernel>>(programs.size());
  }
  for (std::size_t i = 0; i < programs.size(); ++i) {
    std::vector<StageReport>* reports = stages != nullptr ? &(*stages)[i] : nullptr;
    programs[i] = lower(std::move(programs[i]), options, reports);
    const std::string doing = fmt::format("making the kernel '{}'", programs[i].name);
    if (report_if_due(options.stop, doing, {}, diagnostics)) {
      return std::vector<std::shared_ptr<const Kernel>>(programs.size());
    }
    if (options.backend != Backend::jit || reports == nullptr) continue;
    if (is_too_large(programs[i], options)) continue;
    const auto dump = [&](const char* name, auto&& text_of) {
      StageReport report;
      report.name = name;
      report.text = text_of(programs[i], codegen_options(options), diagnostics);
      reports->push_back(std::move(report));
    };
    if (options.dump_ir) dump("llvm", dump_ir);
    if (options.dump_assembly) dump("assembly", dump_assembly);
  }
  const std::vector<bool> fits = refuse_excess(programs, options, diagnostics);
  if (options.backend == Backend::jit) {
    assert(service != nullptr);
    return in_their_places(make_machine_code(std::move(programs), options, *service, diagnostics),
                           fits);
  }
  std::vector<std::shared_ptr<const Kernel>> kernels;
  for (Program& program : programs) {
    kernels.push_back(options.backend == Backend::reference
                          ? make_reference(std::move(program), options.max_steps)
                          : make_interpreter(std::move(program), options.max_steps));
  }
  return in_their_places(std::move(kernels), fits);
}

std::shared_ptr<const Kernel> compile(Program program, const CompileOptions& options,
                                      CompileService* service, Diagnostics& diagnostics,
                                      std::vector<StageReport>* stages) {
  std::vector<Program> programs;
  programs.push_back(std::move(program));
  std::vector<std::vector<StageReport>> reports;
  auto kernel = compile_all(std::move(programs), options, service, diagnostics, &reports).front();
  if (stages != nullptr) {
    for (StageReport& report : reports.front()) stages->push_back(std::move(report));
  }
  return kernel;
}

}  // namespace nacre
