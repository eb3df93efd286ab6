#include "jit/compile/compile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
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

/// Whether no engine may have it; says so.
bool is_refused(const Program& program, const CompileOptions& options, Diagnostics& diagnostics) {
  if (is_too_large(program, options)) {
    diagnostics.error("program-too-large", {},
                      fmt::format("the kernel '{}' is too large", program.name),
                      fmt::format("at most {} instructions", options.max_instructions),
                      fmt::format("{}", instruction_count(program)));
    return true;
  }
  // Even if every loop runs one round.
  const double steps = function_costs(program).front().once;
  if (steps <= static_cast<double>(options.max_steps)) return false;
  diagnostics.error("too-many-steps", {},
                    fmt::format("the kernel '{}' takes too long for each point", program.name),
                    fmt::format("at most {} steps", options.max_steps),
                    fmt::format("{:.3g}", steps));
  return true;
}

/// What code is known by that is made of a Program which lower_to_interface() has given.
std::string key_of(const Program& program, const CompileOptions& options,
                   const CodegenOptions& codegen) {
  return code_key(program, codegen,
                  fmt::format("lowered, at most {} instructions{}", options.max_instructions,
                              options.all_varying ? ", all varying" : ""));
}

/// LLVM's text of a Program as a stage more.
void dump(const Program& program, const CompileOptions& options, std::vector<StageReport>& reports,
          Diagnostics& diagnostics) {
  const auto add = [&](const char* name, auto&& text_of) {
    StageReport report;
    report.name = name;
    report.text = text_of(program, codegen_options(options), diagnostics);
    reports.push_back(std::move(report));
  };
  if (options.dump_ir) add("llvm", dump_ir);
  if (options.dump_assembly) add("assembly", dump_assembly);
}

/// Programs on their way to kernels, each to its place.
class Kernels {
 public:
  using List = std::vector<std::shared_ptr<const Kernel>>;

  Kernels(std::size_t count, const CompileOptions& options, CompileService* service,
          Diagnostics& diagnostics)
      : options_(options), service_(service), diagnostics_(diagnostics), made_(count) {}

  /// Lowers one, as far as is needed. False once time is up, after a diagnostic.
  bool add(std::size_t place, Program program, std::vector<StageReport>* reports) {
    program = lower_to_interface(std::move(program), options_, reports);
    if (is_over(program)) return false;
    const bool is_jit = options_.backend == Backend::jit;
    std::string key;
    if (is_jit && !is_too_large(program, options_)) {
      key = key_of(program, options_, codegen_);
      const bool may_skip = !options_.whole && !options_.dump_ir && !options_.dump_assembly;
      if (auto found = may_skip ? service_->find(program, key, codegen_) : nullptr) {
        const Diagnostics said = found->diagnostics();
        for (const Diagnostic& one : said.all()) diagnostics_.add(one);
        made_[place] = std::move(found);
        return true;
      }
    }
    if (!is_too_large(program, options_)) {
      program = lower_to_engine(std::move(program), options_, reports);
    }
    if (is_over(program)) return false;
    if (is_refused(program, options_, diagnostics_)) return true;
    if (is_jit && reports != nullptr) dump(program, options_, *reports, diagnostics_);
    places_.push_back(place);
    requests_.push_back({std::move(program), std::move(key)});
    return true;
  }

  List take() {
    List others = options_.backend == Backend::jit ? by_service() : by_this_thread();
    for (std::size_t i = 0; i < places_.size(); ++i) made_[places_[i]] = std::move(others[i]);
    return std::move(made_);
  }

 private:
  bool is_over(const Program& program) {
    return report_if_due(options_.stop, fmt::format("making the kernel '{}'", program.name), {},
                         diagnostics_);
  }

  List by_service() {
    if (!options_.asynchronous) {
      auto kernels = service_->request_all(std::move(requests_), codegen_, diagnostics_,
                                           options_.stop.within(options_.max_seconds));
      return {kernels.begin(), kernels.end()};
    }
    List kernels;
    for (CodeRequest& request : requests_) {
      kernels.push_back(service_->request_async(std::move(request), codegen_, options_.priority));
    }
    return kernels;
  }

  List by_this_thread() {
    List kernels;
    for (auto& [program, key] : requests_) {
      kernels.push_back(options_.backend == Backend::reference
                            ? make_reference(std::move(program), options_.max_steps)
                            : make_interpreter(std::move(program), options_.max_steps));
    }
    return kernels;
  }

  const CompileOptions& options_;
  /// Of the JIT; what it is needs LLVM, which the other engines do without.
  const CodegenOptions codegen_ =
      options_.backend == Backend::jit ? codegen_options(options_) : CodegenOptions{};
  CompileService* service_;
  Diagnostics& diagnostics_;
  List made_;                        ///< By place; null where refused.
  std::vector<std::size_t> places_;  ///< Of the requests.
  std::vector<CodeRequest> requests_;
};

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
  const std::size_t count = programs.size();
  if (stages != nullptr) stages->resize(count);
  if (options.lanes != 0 && !is_lane_count(options.lanes)) {
    diagnostics.error("bad-lanes", {}, "there is no code of so many lanes",
                      "1, 4, 8 or 16, or 0 for the widest that pays",
                      fmt::format("{}", options.lanes));
    return Kernels::List(count);
  }
  if (options.backend == Backend::jit && service == nullptr) {
    diagnostics.error("no-service", {}, "machine code is made by a CompileService", "one", "null");
    return Kernels::List(count);
  }
  Kernels kernels(count, options, service, diagnostics);
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<StageReport>* reports = stages != nullptr ? &(*stages)[i] : nullptr;
    if (!kernels.add(i, std::move(programs[i]), reports)) return Kernels::List(count);
  }
  return kernels.take();
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
