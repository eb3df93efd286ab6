#include "runtime/interpreter/prepared.h"

#include "runtime/program/once.h"
#include "runtime/program/region.h"

namespace nacre {

namespace {

/// Fills next_merge and mask.
void find_merges(Prepared& prepared) {
  const std::vector<Instruction>& code = prepared.function->code;
  prepared.next_merge.assign(code.size(), no_value);
  prepared.mask.assign(code.size(), no_value);
  struct Open {
    std::size_t at;
    std::size_t last;  ///< Of its merges, or itself.
  };
  std::vector<Open> open;
  for (std::size_t i = 0; i < code.size(); ++i) {
    if (opens_region(code[i].op)) open.push_back({i, i});
    if (code[i].op == Op::merge) {
      prepared.next_merge[open.back().last] = static_cast<ValueId>(i);
      prepared.mask[i] = code[open.back().at].operands[0];
      open.back().last = i;
    }
    if (closes_region(code[i].op)) open.pop_back();
  }
}

std::vector<Step> steps_of(const Function& function, const std::vector<bool>& once,
                           const RegisterMap& registers) {
  const LaneOps& ops = lane_ops();
  std::vector<Step> steps(function.code.size());
  const auto register_of = [&](ValueId id) {
    return id == no_value || registers.of[id] == no_value ? 0 : registers.of[id];
  };
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Instruction& instruction = function.code[i];
    Step& step = steps[i];
    step.run = ops.of[static_cast<std::size_t>(instruction.op)];
    step.turn = instruction.op == Op::constant ? Turn::never : once[i] ? Turn::once : Turn::each;
    step.registers[0] = register_of(static_cast<ValueId>(i));
    for (std::size_t k = 0; k < instruction.count; ++k) {
      step.registers[k + 1] = register_of(instruction.operands[k]);
    }
  }
  return steps;
}

Prepared prepare(const Function& function, const std::vector<bool>& once,
                 const FunctionCost& cost) {
  Prepared prepared{.function = &function,
                    .registers = assign_registers(function, once),
                    .steps = {},
                    .end = region_ends(function),
                    .next_merge = {},
                    .mask = {},
                    .round = std::vector<double>(function.code.size(), 0)};
  find_merges(prepared);
  prepared.steps = steps_of(function, once, prepared.registers);
  for (const auto& [open, steps] : cost.rounds) prepared.round[open] = steps;
  return prepared;
}

}  // namespace

std::vector<Prepared> prepare(const Program& program) {
  const std::vector<FunctionCost> costs = function_costs(program);
  std::vector<Prepared> all{prepare(program.entry(), once_per_call(program.entry()), costs[0])};
  for (std::size_t i = 1; i < costs.size(); ++i) {
    const Function& function = program.functions[i];
    all.push_back(prepare(function, std::vector<bool>(function.code.size(), false), costs[i]));
  }
  return all;
}

}  // namespace nacre
