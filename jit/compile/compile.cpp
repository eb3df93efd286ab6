#include "jit/compile/compile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "jit/compile/fact_kernel.h"
#include "jit/compile/lower.h"
#include "jit/compile/two_widths.h"
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
  std::string way =
      fmt::format("lowered, at most {} instructions, tables within {}{}", options.max_instructions,
                  table_error_of(options), options.all_varying ? ", all varying" : "");
  const std::vector<bool> fitted = fitted_slots(program, options);
  if (!fitted.empty()) way += ", fitted ";
  for (const bool is_fitted : fitted) way += is_fitted ? '1' : '0';
  for (const Fact& fact : facts_of(options.facts, program)) {
    way += (fact.is_implied ? "; implied " : "; ") + to_string(fact);
  }
  return code_key(program, codegen, way);
}

/// A kernel of a Program that lower_to_interface() has given, without what facts leave out.
/// `service` may be gone.
std::shared_ptr<const Kernel> general_kernel(const Program& program, CompileOptions options,
                                             const std::weak_ptr<CompileService>& service) {
  options.facts.clear();
  options.whole = options.keep_text = options.dump_ir = options.dump_assembly = false;
  const std::shared_ptr<CompileService> alive = service.lock();
  if (alive != nullptr && options.backend == Backend::jit) {
    Diagnostics said;
    if (auto kernel = compile(program, options, alive.get(), said)) return kernel;
  }
  // What is too large for others is interpreted.
  options.backend = Backend::interpreter;
  options.stop = {};
  options.max_instructions = std::size_t{1} << 31;
  return make_interpreter(lower(program, options), options.max_steps);
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

/// What Programs become machine code for: one number of lanes, and what the service makes for it.
class Width {
 public:
  Width(std::size_t count, const CodegenOptions& codegen) : codegen_(codegen), made_(count) {}

  const CodegenOptions& codegen() const { return codegen_; }
  /// Takes what the service has already.
  bool find(std::size_t place, const Program& program, const std::string& key,
            CompileService& service, Diagnostics& diagnostics) {
    std::shared_ptr<CompiledKernel> found = service.find(program, key, codegen_);
    if (found == nullptr) return false;
    const Diagnostics said = found->diagnostics();
    for (const Diagnostic& one : said.all()) diagnostics.add(one);
    made_[place] = std::move(found);
    return true;
  }
  void add(std::size_t place, Program program, std::string key) {
    if (made_[place] != nullptr) return;
    places_.push_back(place);
    requests_.push_back({std::move(program), std::move(key)});
  }
  /// Null where the service refuses.
  std::vector<std::shared_ptr<CompiledKernel>> take(CompileService& service,
                                                    const CompileOptions& options,
                                                    Diagnostics& diagnostics) {
    std::vector<std::shared_ptr<CompiledKernel>> asked;
    if (options.asynchronous) {
      for (CodeRequest& request : requests_) {
        asked.push_back(service.request_async(std::move(request), codegen_, options.priority));
      }
    } else {
      asked = service.request_all(std::move(requests_), codegen_, diagnostics,
                                  options.stop.within(options.max_seconds));
    }
    for (std::size_t i = 0; i < places_.size(); ++i) made_[places_[i]] = std::move(asked[i]);
    return std::move(made_);
  }

 private:
  CodegenOptions codegen_;
  std::vector<std::shared_ptr<CompiledKernel>> made_;  ///< By place.
  std::vector<std::size_t> places_;                    ///< Of the requests.
  std::vector<CodeRequest> requests_;
};

/// Programs on their way to kernels, each to its place.
class Kernels {
 public:
  using List = std::vector<std::shared_ptr<const Kernel>>;

  Kernels(std::size_t count, const CompileOptions& options, CompileService* service,
          Diagnostics& diagnostics)
      : options_(options), service_(service), diagnostics_(diagnostics), made_(count) {
    // What a target is needs LLVM, which the other engines do without.
    if (options_.backend != Backend::jit) return;
    CodegenOptions codegen = codegen_options(options_);
    widths_.emplace_back(count, codegen);
    if (!options_.single_points || codegen.lanes == 1) return;
    codegen.lanes = 1;
    widths_.emplace_back(count, codegen);
  }

  /// Lowers one, as far as is needed. False once time is up, after a diagnostic.
  bool add(std::size_t place, Program program, std::vector<StageReport>* reports) {
    program = lower_to_interface(std::move(program), options_, reports);
    if (is_over(program)) return false;
    if (has_check(program, options_)) note_general(place, program);
    std::vector<std::string> keys;
    if (!is_too_large(program, options_)) {
      const bool may_skip = !options_.whole && !options_.dump_ir && !options_.dump_assembly;
      std::size_t found = 0;
      std::optional<Program> checked;
      if (generals_.contains(place)) checked = with_checked_output(program);
      const Program& bound = checked ? *checked : program;
      for (Width& width : widths_) {
        keys.push_back(key_of(program, options_, width.codegen()));
        found += may_skip && width.find(place, bound, keys.back(), *service_, diagnostics_);
      }
      if (found != 0 && found == widths_.size()) return true;
      program = lower_to_engine(std::move(program), options_, reports);
    }
    if (is_over(program)) return false;
    if (is_refused(program, options_, diagnostics_)) return true;
    if (widths_.empty()) {
      made_[place] = on_this_thread(std::move(program));
      return true;
    }
    if (reports != nullptr) dump(program, options_, *reports, diagnostics_);
    for (std::size_t i = 1; i < widths_.size(); ++i) widths_[i].add(place, program, keys[i]);
    widths_.front().add(place, std::move(program), keys.front());
    return true;
  }

  List take() {
    std::vector<std::vector<std::shared_ptr<CompiledKernel>>> made;
    for (Width& width : widths_) {
      // What is refused at one width is at the other.
      if (!made.empty() && std::ranges::count(made.front(), nullptr) != 0) break;
      made.push_back(width.take(*service_, options_, diagnostics_));
    }
    for (std::size_t i = 0; !made.empty() && i < made_.size(); ++i) {
      std::shared_ptr<CompiledKernel>& kernel = made.front()[i];
      const bool has_single = kernel != nullptr && made.size() > 1 && made.back()[i] != nullptr;
      made_[i] = has_single ? of_two_widths(std::move(kernel), std::move(made.back()[i]))
                            : std::move(kernel);
    }
    for (auto& [place, general] : generals_) {
      if (made_[place] == nullptr) continue;
      made_[place] = std::make_shared<FactKernel>(std::move(made_[place]), std::move(general));
    }
    return std::move(made_);
  }

 private:
  /// What its facts may not hold for.
  void note_general(std::size_t place, const Program& program) {
    std::weak_ptr<CompileService> service;
    if (service_ != nullptr) service = service_->weak_from_this();
    CompileOptions options = options_;
    // In `fast` the interpreter's bits are others, and no run waits for a compiler: it is made now.
    const bool is_made_now = options.accuracy == Accuracy::fast;
    if (is_made_now) {
      generals_[place] = [made = general_kernel(program, options, service)] { return made; };
    } else {
      options.asynchronous = true;
      options.stop = {};  // Of a call that is over then.
      generals_[place] = [program, options, service] {
        return general_kernel(program, options, service);
      };
    }
  }

  /// What is bound to code that is there, of what is not lowered any further.
  static Program with_checked_output(Program program) {
    program.outputs.push_back({outside_facts_channel, Scalar::i32});
    return program;
  }

  bool is_over(const Program& program) {
    return report_if_due(options_.stop, fmt::format("making the kernel '{}'", program.name), {},
                         diagnostics_);
  }

  std::unique_ptr<Kernel> on_this_thread(Program program) const {
    return options_.backend == Backend::reference
               ? make_reference(std::move(program), options_.max_steps)
               : make_interpreter(std::move(program), options_.max_steps);
  }

  const CompileOptions& options_;
  CompileService* service_;
  Diagnostics& diagnostics_;
  List made_;                                                ///< By place; null where refused.
  std::map<std::size_t, FactKernel::MakeGeneral> generals_;  ///< By place, where there are facts.
  std::vector<Width> widths_;                                ///< None but for the JIT.
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
  if (!check_facts(options.facts, diagnostics)) return Kernels::List(count);
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
