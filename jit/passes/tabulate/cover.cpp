#include "jit/passes/tabulate/cover.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace nacre {

namespace {

/// A value that takes no more operations beside others of its group is computed.
constexpr double least_cost = 8;

}  // namespace

double operation_cost(Op op, double error) {
  if (is_transcendental(op)) return error < 1e-4 ? 25 : 16;
  switch (op) {
    case Op::constant: return 0;
    case Op::div: return 6;
    case Op::sqrt: return 8;
    case Op::table: return 10;
    default: return 1;
  }
}

Computation::Computation(const Program& program, const Groups& groups,
                         const std::vector<ValueId>& outputs, double error) {
  Cone cone;
  for (const ValueId output : outputs) groups.add_cone(output, cone);
  values_.assign(cone.begin(), cone.end());
  const Function& function = program.entry();
  for (const ValueId value : values_) {
    const Instruction& instruction = function.code[value];
    is_number_.push_back(instruction.type == Scalar::f32);
    is_of_parameters_.push_back(groups.is_of_parameters(value));
    costs_.push_back(is_of_parameters_.back() ? 0 : operation_cost(instruction.op, error));
    std::vector<std::size_t>& operands = operands_.emplace_back();
    bool has_key = false;
    for (const ValueId operand : function.operands(instruction)) {
      if (cone.contains(operand)) {
        operands.push_back(at(operand));
      } else {
        has_key = has_key || function.code[operand].op != Op::constant;
      }
    }
    has_key_.push_back(has_key);
  }
}

std::size_t Computation::at(ValueId value) const {
  const auto found = std::ranges::lower_bound(values_, value);
  return static_cast<std::size_t>(found - values_.begin());
}

bool Computation::has(ValueId value) const { return std::ranges::binary_search(values_, value); }

std::vector<std::size_t> Computation::of_alone(std::size_t i) const {
  std::vector<bool> is_of(size(), false);
  is_of[i] = true;
  std::vector<std::size_t> found;
  for (std::size_t k = i + 1; k < size(); ++k) {
    const auto is_other = [&](std::size_t operand) {
      return !is_of[operand] && !is_of_parameters_[operand];
    };
    // Operands that are no part of the computation are constants, or the group's key.
    if (operands_[k].empty() || has_key_[k] || is_of_parameters_[k] ||
        std::ranges::any_of(operands_[k], is_other)) {
      continue;
    }
    is_of[k] = true;
    found.push_back(k);
  }
  return found;
}

double Computation::cost() const { return std::reduce(costs_.begin(), costs_.end()); }

double Computation::cost_of(const std::vector<std::size_t>& all) const {
  double sum = 0;
  for (const std::size_t i : all) sum += costs_[i];
  return sum;
}

std::vector<std::size_t> Computation::below(std::size_t i, const std::vector<bool>& done) const {
  std::vector<bool> seen = done;
  std::vector<std::size_t> found, left{i};
  seen[i] = true;
  while (!left.empty()) {
    const std::size_t next = left.back();
    left.pop_back();
    found.push_back(next);
    for (const std::size_t operand : operands_[next]) {
      if (!seen[operand]) left.push_back(operand);
      seen[operand] = true;
    }
  }
  return found;
}

Cover cover(const Computation& computation, const std::vector<std::size_t>& outputs,
            const std::vector<bool>& computed, const std::vector<Tables>& all,
            const std::vector<std::size_t>& chosen) {
  const std::size_t size = computation.size();
  Cover found{.tables = std::vector<std::optional<std::size_t>>(size)};
  std::vector<bool> is_done = computed, is_wanted(size, false);
  for (const std::size_t output : outputs) is_wanted[output] = true;
  for (std::size_t i = size; i-- > 0;) {
    if (!is_wanted[i] || is_done[i]) continue;
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t k : chosen) {
      if (!all[k].has(i) || all[k].cost(i) >= least) continue;
      least = all[k].cost(i);
      found.tables[i] = k;
    }
    is_done[i] = true;
    if (found.tables[i]) {
      const ValueId key = all[*found.tables[i]].key;
      if (computation.has(key)) is_wanted[computation.at(key)] = true;
      continue;
    }
    for (const std::size_t operand : computation.operands(i)) is_wanted[operand] = true;
  }
  // Of what is computed or looked up others may be computed cheaply, until nothing changes.
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (std::size_t i = 0; i < size; ++i) {
      if (!found.tables[i]) continue;
      const std::vector<std::size_t> more = computation.below(i, is_done);
      const double price = std::max(all[*found.tables[i]].cost(i), least_cost);
      if (computation.cost_of(more) > price) continue;
      for (const std::size_t each : more) is_done[each] = true;
      found.tables[i].reset();
      has_changed = true;
    }
  }
  std::vector<bool> is_used(all.size(), false);
  for (std::size_t i = 0; i < size; ++i) {
    if (!is_done[i]) continue;
    if (const auto k = found.tables[i]) {
      found.cost += all[*k].cost(i);
      if (!is_used[*k]) found.cost += all[*k].fitted.cost_of_cell();
      is_used[*k] = true;
    } else {
      found.cost += computation.cost(i);
    }
  }
  return found;
}

}  // namespace nacre
