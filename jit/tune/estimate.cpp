#include "jit/tune/estimate.h"

#include <vector>

namespace nacre {

namespace {

/// Of vectors as wide as the machine has them, relative to an addition: how often one can begin, by
/// Agner Fog, "Instruction tables" (Zen 4, Ice Lake); a gather is so many loads.
double weight_of(Op op) {
  switch (op) {
    case Op::constant:
    case Op::argument:
    case Op::give:
    case Op::result:
    case Op::keep: return 0;
    case Op::div: return 8;
    case Op::sqrt: return 12;
    case Op::imul:
    case Op::umulhi: return 3;
    case Op::table:
    case Op::texel: return 10;
    case Op::texture_call: return 500;
    default: return is_structural(op) ? 0 : 1;
  }
}

}  // namespace

double estimated_cost(const Program& program) {
  std::vector<double> costs(program.functions.size(), 0);
  const auto add_up = [&](std::size_t f) {
    for (const Instruction& instruction : program.functions[f].code) {
      costs[f] += weight_of(instruction.op);
      if (instruction.op == Op::call) costs[f] += costs[instruction.imm];
    }
  };
  // Callees stand before their callers, and behind the entry.
  for (std::size_t f = 1; f < costs.size(); ++f) add_up(f);
  add_up(0);
  return costs[0];
}

}  // namespace nacre
