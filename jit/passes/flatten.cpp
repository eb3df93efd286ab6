#include "jit/passes/flatten.h"

#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "runtime/program/transform.h"

namespace nacre {

namespace {

/// What testing the mask costs, in additions: the test, a jump that may be mispredicted, and
/// what can no longer be moved and shared across it.
constexpr double cost_of_test = 30;

/// No select stands for these.
constexpr double never_flat = std::numeric_limits<double>::infinity();

/// What the regions of a function cost, by the instruction that opens them, and all of it.
struct Costs {
  std::vector<double> regions;
  double all = 0;
};

/// `callees` have the costs of the functions that may be called, by number.
Costs costs_of(const Function& function, const std::vector<Costs>& callees) {
  Costs costs;
  costs.regions.resize(function.code.size());
  struct Open {
    std::size_t at;
    double cost;
  };
  std::vector<Open> open{{0, 0}};  // The first stands for the function.
  for (std::size_t i = 0; i < function.code.size(); ++i) {
    const Instruction& instruction = function.code[i];
    open.back().cost +=
        instruction.op == Op::call ? callees[instruction.imm].all : cost_of(instruction.op);
    if (opens_region(instruction.op)) open.push_back({i, 0});
    if (!closes_region(instruction.op)) continue;
    const Open done = open.back();
    open.pop_back();
    costs.regions[done.at] = done.cost;
    open.back().cost += done.cost;
  }
  costs.all = open.front().cost;
  return costs;
}

}  // namespace

double cost_of(Op op) {
  if (is_transcendental(op)) return op == Op::pow ? 60 : 30;
  switch (op) {
    case Op::constant:
    case Op::parameter:
    case Op::input:
    case Op::argument:
    case Op::merge:
    case Op::result:
    case Op::give:
    case Op::keep: return 0;
    case Op::div:
    case Op::sqrt: return 8;
    case Op::table:
    case Op::texel: return 16;
    case Op::loop:
    case Op::texture_call: return never_flat;
    default: return 1;
  }
}

Flattening cheap_regions(const Program& program) {
  std::vector<Costs> costs(program.functions.size());
  for (std::size_t i = 1; i < program.functions.size(); ++i) {
    costs[i] = costs_of(program.functions[i], costs);
  }
  costs[0] = costs_of(program.entry(), costs);
  return [&program, costs = std::move(costs)](const Function& function, std::size_t open) {
    const auto number = static_cast<std::size_t>(&function - program.functions.data());
    return costs[number].regions[open] < cost_of_test;
  };
}

Program flatten_regions(const Program& program, std::size_t most) {
  const auto keep = [](Recorder&, const Instruction&, std::span<const Ref>) {
    return std::optional<Ref>();
  };
  Program result = transform(program, keep, most, cheap_regions(program));
  mark_varying(result);
  return result;
}

}  // namespace nacre
