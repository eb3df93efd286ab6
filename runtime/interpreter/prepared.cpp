#include "runtime/interpreter/prepared.h"

#include <utility>

#include "runtime/program/once.h"
#include "runtime/program/region.h"

namespace nacre {

namespace {

Prepared prepare(const Function& function, std::vector<bool> once, const FunctionCost& cost) {
  Prepared prepared{.function = &function,
                    .once = std::move(once),
                    .registers = {},
                    .end = region_ends(function),
                    .round = std::vector<double>(function.code.size(), 0)};
  prepared.registers = assign_registers(function, prepared.once);
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
