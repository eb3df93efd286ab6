#include <functional>
#include <map>
#include <utility>

#include "jit/passes/tabulate/cover.h"
#include "jit/passes/tabulate/plan.h"

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
    for (const ValueId value : cone) {
      if (groups.is_of_parameters(value)) continue;
      cost += operation_cost(program.entry().code[value].op, error);
    }
    if (cost < least_cost_of_a_table + least_saving_of(groups)) continue;  // Most groups.
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

std::vector<Looked> plan_all(const Program& program, const Groups& groups, double error) {
  std::vector<Looked> all;
  for (const ValueId key : worthwhile(program, groups, error)) {
    for (Looked& looked : plan_group(program, groups, key, error)) all.push_back(std::move(looked));
  }
  return all;
}

}  // namespace nacre
