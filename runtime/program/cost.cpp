#include "runtime/program/cost.h"

#include <algorithm>

namespace nacre {

namespace {

/// A look-up that the host answers, for all lanes of a pass.
constexpr double texture_call_steps = 256;

/// What a transcendental function becomes, before it is expanded.
constexpr double transcendental_steps = 32;

/// Of the instruction itself, without what it calls.
double own_steps(const Instruction& instruction) {
  if (instruction.op == Op::constant) return 0;
  if (is_transcendental(instruction.op)) return transcendental_steps;
  return instruction.op == Op::texture_call ? texture_call_steps : 1;
}

FunctionCost function_cost(const Function& function, const std::vector<FunctionCost>& known) {
  FunctionCost cost;
  struct Loop {
    ValueId open;
    double straight = 0;  ///< Of one round, as the members of FunctionCost.
    double once = 0;
    double most = 0;
  };
  std::vector<ValueId> regions;
  std::vector<Loop> loops{{no_value}};  // The first stands for the function itself.
  for (std::size_t i = 0; i < function.code.size(); ++i) {
    const Instruction& instruction = function.code[i];
    if (opens_region(instruction.op)) regions.push_back(static_cast<ValueId>(i));
    if (instruction.op == Op::loop) loops.push_back({static_cast<ValueId>(i)});
    Loop& inner = loops.back();
    const double own = own_steps(instruction);
    inner.straight += own;
    inner.once += own;
    inner.most += own;
    if (instruction.op == Op::call) {
      const FunctionCost& callee = known[instruction.imm];
      inner.straight += callee.straight;
      inner.once += callee.once;
      inner.most += callee.most;
    }
    if (!closes_region(instruction.op)) continue;
    const ValueId open = regions.back();
    regions.pop_back();
    if (function.code[open].op != Op::loop) continue;
    const Loop done = loops.back();
    loops.pop_back();
    cost.rounds.emplace(open, done.straight);
    loops.back().once += done.once;
    loops.back().most += done.most * loop_bound(function.code[open].imm);
  }
  cost.straight = loops.front().straight;
  cost.once = loops.front().once;
  cost.most = loops.front().most;
  return cost;
}

}  // namespace

std::vector<FunctionCost> function_costs(const Program& program) {
  std::vector<FunctionCost> costs(program.functions.size());
  for (std::size_t i = 1; i < program.functions.size(); ++i) {
    costs[i] = function_cost(program.functions[i], costs);
  }
  costs[0] = function_cost(program.entry(), costs);
  return costs;
}

double cost_once(const Function& function, std::size_t first, const std::vector<double>& once) {
  double sum = 0;
  for (std::size_t i = first; i < function.code.size(); ++i) {
    const Instruction& instruction = function.code[i];
    sum += own_steps(instruction);
    if (instruction.op == Op::call) sum += once[instruction.imm];
  }
  return sum;
}

StepLimit::StepLimit(const Program& program, std::uint64_t max_steps) : max_steps_(max_steps) {
  const double most = function_costs(program).front().most;
  // However many are allowed: what counts also looks for a request to stop.
  is_counted_ = most > static_cast<double>(std::min(max_steps, default_max_steps));
  can_fail_ = is_counted_;
  for (const Function& function : program.functions) {
    for (const Instruction& instruction : function.code) {
      if (instruction.op == Op::loop && (instruction.imm & loop_must_end) != 0) can_fail_ = true;
    }
  }
  constexpr double steps_between_looks = 2e6;
  passes_between_looks_ = static_cast<std::uint64_t>(
      std::clamp(steps_between_looks / std::max(most, 1.0), 1.0, 1048576.0));
}

}  // namespace nacre
