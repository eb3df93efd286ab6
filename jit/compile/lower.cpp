#include "jit/compile/lower.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "jit/compile/facts.h"
#include "jit/compile/stages.h"
#include "jit/passes/contract.h"
#include "jit/passes/decide.h"
#include "jit/passes/derive.h"
#include "jit/passes/expand_math.h"
#include "jit/passes/flatten.h"
#include "jit/passes/scale_footprints.h"
#include "jit/passes/sink.h"
#include "jit/passes/tabulate/fit_parameters.h"
#include "jit/passes/tabulate/tabulate.h"
#include "runtime/float_environment.h"

namespace nacre {

namespace {

/// Runs passes on a Program, each timed and reported, until it is too large or time is up.
class Passes {
 public:
  Passes(Program program, const CompileOptions& options, std::vector<StageReport>* reports)
      : program_(std::move(program)), options_(options), stages_(reports) {}

  template <class Pass>
  void run(const char* name, const Pass& pass, std::vector<FactUse> facts = {}) {
    if (is_over()) return;
    program_ = stages_.run(
        name, [&] { return pass(program_); },
        [&](const Program& made, StageReport& report) {
          report.facts = std::move(facts);
          report.instructions = instruction_count(made);
          const bool is_wanted = options_.keep_text && !is_over(made);
          if (is_wanted) report.text = to_string(made);
        });
    assert(is_over() || verify(program_).empty());
  }
  bool is_over() const { return is_over(program_) || options_.stop.is_due(); }
  Program& program() { return program_; }

 private:
  bool is_over(const Program& program) const { return is_too_large(program, options_); }

  const ScopedDefaultFloatEnvironment environment_;
  Program program_;
  const CompileOptions& options_;
  Stages stages_;
};

/// How large a Program is, and what it takes in additions where no lane enters a region: facts that
/// are so exclude what no lane does then.
struct Size {
  std::size_t instructions = 0;
  double cost = 0;
};

Size size_of(const Program& program) {
  Size size{instruction_count(program), 0};
  int depth = 0;
  for (const Instruction& instruction : program.entry().code) {
    if (opens_region(instruction.op)) ++depth;
    if (closes_region(instruction.op)) --depth;
    const double cost = cost_of(instruction.op);
    if (depth == 0 && std::isfinite(cost)) size.cost += cost;
    // A jump that is foreseen, and what it keeps apart.
    if (depth == 1 && opens_region(instruction.op)) size.cost += 8;
  }
  return size;
}

/// Those facts that leave out more which the others do not than it takes to look at them, each with
/// what it does, if that was tried.
std::vector<FactUse> used_facts(const Program& program, const CompileOptions& options) {
  // What is looked at once a call, and what is implied, is used in any case.
  constexpr std::size_t most_tried = 16;
  std::vector<Fact> facts = facts_of(options.facts, program);
  const auto is_free = [&](const Fact& fact) { return cost_of_check(fact, program) == 0; };
  const auto is_stated = [&](const Fact& fact) { return is_free(fact) && !fact.is_implied; };
  const bool tries_free = options.whole || static_cast<std::size_t>(std::ranges::count_if(
                                               facts, is_stated)) <= most_tried;
  std::vector<FactUse> uses;
  const auto size_with = [&] {
    const Known known = known_by(facts, program, options.accuracy);
    return size_of(decide(program, known, options.max_instructions));
  };
  const Size least = facts.empty() ? Size{} : size_with();
  for (std::size_t i = 0; i < facts.size() && !options.stop.is_due();) {
    const Fact fact = facts[i];
    if (is_free(fact) && (fact.is_implied || !tries_free)) {
      uses.push_back({fact, std::nullopt});
      ++i;
      continue;
    }
    facts.erase(facts.begin() + static_cast<std::ptrdiff_t>(i));
    const Size without = size_with();
    if (!is_free(fact) && without.cost - least.cost <= cost_of_check(fact, program)) continue;
    const bool is_less = without.instructions > least.instructions;
    uses.push_back({fact, is_less ? without.instructions - least.instructions : 0});
    facts.insert(facts.begin() + static_cast<std::ptrdiff_t>(i), fact);
    ++i;
  }
  return uses;
}

}  // namespace

double table_error_of(const CompileOptions& options) {
  // Precise computes what was written; standard may be off by as much as some roundings are.
  constexpr std::array by_accuracy{0.0, 1e-5, 1e-3};
  if (options.backend == Backend::reference) return 0;
  return options.table_error.value_or(by_accuracy[static_cast<std::size_t>(options.accuracy)]);
}

std::vector<bool> fitted_slots(const Program& program, const CompileOptions& options) {
  if (!options.fits_slot || table_error_of(options) <= 0) return {};
  std::vector<bool> fitted;
  for (const ParameterSlot& slot : program.parameters) {
    fitted.push_back(options.fits_slot(slot.name));
  }
  if (std::ranges::find(fitted, true) == fitted.end()) fitted.clear();
  return fitted;
}

bool has_check(const Program& program, const CompileOptions& options) {
  return options.backend != Backend::reference && !facts_of(options.facts, program).empty();
}

bool is_too_large(const Program& program, const CompileOptions& options) {
  return instruction_count(program) > options.max_instructions;
}

Program lower_to_interface(Program program, const CompileOptions& options,
                           std::vector<StageReport>* reports) {
  Passes passes(std::move(program), options, reports);
  passes.run("slice", [](const Program& p) { return p; });

  // Footprint derivatives become arithmetic on derivative channels.
  passes.run("derive", [&](const Program& p) { return derive(p, {}, options.max_instructions); });
  return std::move(passes.program());
}

Program lower_to_engine(Program program, const CompileOptions& options,
                        std::vector<StageReport>* reports) {
  Passes passes(std::move(program), options, reports);
  const bool contracts =
      options.backend != Backend::reference && options.accuracy != Accuracy::precise;
  if (contracts) {
    // What costs less than a branch is computed for all lanes; a * b + c in one rounding.
    passes.run("contract", [](const Program& p) { return contract(p, true); });
  } else {
    // Precise rounds as the node's body says, and the oracle computes what was written.
    passes.run("flatten",
               [&](const Program& p) { return flatten_regions(p, options.max_instructions); });
  }
  // Last: what is rounded is chosen as if the host had multiplied.
  const auto scale = [&] {
    if (offers_footprint_scale(passes.program())) passes.run("scale_footprints", scale_footprints);
    return std::move(passes.program());
  };
  if (options.backend == Backend::reference) return scale();

  // What depends on one number alone comes of tables, if they may be off.
  if (const double error = table_error_of(options); error > 0) {
    passes.run("tabulate", [&](const Program& p) { return tabulate(p, error); });
    if (auto slots = fitted_slots(passes.program(), options); !slots.empty()) {
      passes.run("fit_parameters", [&](const Program& p) {
        // Beside fits stands what they are of: a Program that is nearly too large has none.
        Program made = fit_parameters(p, error, std::move(slots));
        return is_too_large(made, options) ? p : made;
      });
    }
  }

  // Transcendental functions become polynomials of the accuracy asked for.
  passes.run("expand_math", [&](const Program& p) {
    return expand_math(p, options.accuracy, options.max_instructions);
  });

  if (passes.is_over()) return std::move(passes.program());
  for (Fit& fit : passes.program().fits) {
    fit.maker = std::make_shared<const Program>(
        expand_math(*fit.maker, options.accuracy, options.max_instructions));
  }

  // What is known of what is read changes no bit, so it comes after what rounds.
  std::vector<FactUse> uses;
  std::vector<Fact> facts;
  if (!options.facts.empty() && !passes.is_over()) uses = used_facts(passes.program(), options);
  for (const FactUse& use : uses) facts.push_back(use.fact);
  passes.run(
      "decide",
      [&](const Program& p) {
        return decide(p, known_by(facts, p, options.accuracy), options.max_instructions);
      },
      std::move(uses));
  if (has_check(passes.program(), options)) {
    passes.run("check",
               [&](const Program& p) { return with_check(p, facts, options.max_instructions); });
  }
  passes.run("sink", sink);
  Program made = scale();
  if (options.all_varying && !is_too_large(made, options) && !options.stop.is_due()) {
    mark_varying(made, true);
  }
  return made;
}

Program lower(Program program, const CompileOptions& options, std::vector<StageReport>* reports) {
  Program made = lower_to_interface(std::move(program), options, reports);
  const bool is_over = is_too_large(made, options) || options.stop.is_due();
  return is_over ? made : lower_to_engine(std::move(made), options, reports);
}

}  // namespace nacre
