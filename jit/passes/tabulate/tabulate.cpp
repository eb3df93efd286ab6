#include "jit/passes/tabulate/tabulate.h"

#include <functional>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "jit/passes/tabulate/cover.h"
#include "jit/passes/tabulate/groups.h"
#include "jit/passes/tabulate/plan.h"
#include "runtime/program/recorder.h"
#include "runtime/program/transform.h"

namespace nacre {

namespace {

/// What may be done to find tables for a Program, in operations of the reference engine, well below
/// a second: for a group at all, and for each operation of it.
constexpr double most_work = 5e7, work_of_a_group = 2e4, work_of_an_operation = 1200;

/// Keys of the groups that may save something, those that may save the most first, as many as can
/// be looked at in time: all that may save as much or none of them, whichever was recorded first.
std::vector<ValueId> worthwhile(const Program& program, const Groups& groups, double error) {
  std::map<double, std::vector<std::pair<ValueId, double>>, std::greater<>> by_cost;
  for (const auto& [key, outputs] : groups.outputs()) {
    Cone cone;
    for (const ValueId output : outputs) groups.add_cone(output, cone);
    double cost = 0;
    for (const ValueId value : cone) cost += operation_cost(program.entry().code[value].op, error);
    if (cost < least_cost_of_a_table + least_saving) continue;  // Most groups.
    by_cost[cost].emplace_back(key, work_of_a_group + work_of_an_operation * double(cone.size()));
  }
  std::vector<ValueId> keys;
  double work = 0;
  for (const auto& [cost, alike] : by_cost) {
    for (const auto& [key, own] : alike) work += own;
    if (work > most_work) break;
    for (const auto& [key, own] : alike) keys.push_back(key);
  }
  return keys;
}

}  // namespace

Program tabulate(const Program& program, double error) {
  Program marked = program;
  mark_varying(marked);
  const Groups groups(marked);
  std::vector<Looked> all;
  for (const ValueId key : worthwhile(marked, groups, error)) {
    for (Looked& looked : plan_group(marked, groups, key, error)) all.push_back(std::move(looked));
  }
  if (all.empty()) return program;
  const Function& entry = marked.entry();
  std::unordered_map<ValueId, std::pair<const Looked*, std::size_t>> looked;
  std::unordered_map<ValueId, Ref> keys;
  for (const Looked& group : all) {
    keys[group.key] = {};
    for (std::size_t k = 0; k < group.values.size(); ++k) looked[group.values[k]] = {&group, k};
  }
  const auto replace = [&](Recorder& recorder, const Instruction& instruction,
                           std::span<const Ref> operands) -> std::optional<Ref> {
    const auto value = static_cast<ValueId>(&instruction - entry.code.data());
    if (&instruction < entry.code.data() || value >= entry.code.size()) return std::nullopt;
    const auto key = keys.find(value);
    std::optional<Ref> made;
    if (const auto found = looked.find(value); found != looked.end()) {
      const auto& [group, function] = found->second;
      made = record_looked(recorder, marked, groups, *group, function, keys.at(group->key));
    } else if (key != keys.end()) {
      made = recorder.emit(instruction.op, operands, instruction.imm);
    }
    if (key != keys.end()) key->second = *made;
    return made;
  };
  Program made = transform(marked, replace);
  mark_varying(made);
  return made;
}

}  // namespace nacre
