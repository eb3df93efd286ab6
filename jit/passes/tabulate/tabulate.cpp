#include "jit/passes/tabulate/tabulate.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "jit/passes/tabulate/groups.h"
#include "jit/passes/tabulate/piecewise.h"
#include "jit/passes/tabulate/sampler.h"
#include "runtime/program/recorder.h"
#include "runtime/program/transform.h"

namespace nacre {

namespace {

/// What tables save of a group must be more than that, in operations.
constexpr double least_saving = 12;
/// A value that costs no more beside others of its group is computed.
constexpr double least_cost = 8;
/// What may be done to find tables for a Program, in operations of the reference engine, well below
/// a second: for a group at all, and for each operation of it.
constexpr double most_work = 5e7, work_of_a_group = 2e4, work_of_an_operation = 1200;
/// As many entries as CPUs keep in registers.
constexpr int most_cells = 32;

/// A group that is looked up: its values, in the order of the functions.
struct Looked {
  ValueId key;
  std::vector<ValueId> values;
  Piecewise fitted;
  ValueId place;  ///< Of an axis that is given by a value of the group.
};

class Tabulator {
 public:
  Tabulator(const Program& program, double error)
      : program_(program), groups_(program), error_(error) {}

  const Groups& groups() const { return groups_; }

  std::vector<Looked> run() const {
    std::vector<Looked> all;
    for (const ValueId key : worthwhile()) {
      if (auto made = look_up(key, groups_.outputs().at(key))) all.push_back(std::move(*made));
    }
    return all;
  }

 private:
  const Instruction& at(ValueId value) const { return program_.entry().code[value]; }
  Cone cone_of(const std::vector<ValueId>& values) const {
    Cone cone;
    for (const ValueId value : values) groups_.add_cone(value, cone);
    return cone;
  }

  double cost(const Cone& cone, const Cone& less) const {
    double sum = 0;
    for (const ValueId value : cone) {
      if (!less.contains(value)) sum += operation_cost(at(value).op);
    }
    return sum;
  }

  /// Keys of the groups that may save something, those that may save the most first, as many as can
  /// be looked at in time: all that may save as much or none of them, whichever was recorded first.
  std::vector<ValueId> worthwhile() const {
    std::map<double, std::vector<std::pair<ValueId, double>>, std::greater<>> by_cost;
    for (const auto& [key, outputs] : groups_.outputs()) {
      const Cone cone = cone_of(outputs);
      const double all = cost(cone, {});
      if (all < least_cost_of_tables(1) + least_saving) continue;  // Most groups.
      by_cost[all].emplace_back(key, work_of_a_group + work_of_an_operation * double(cone.size()));
    }
    std::vector<ValueId> keys;
    double work = 0;
    for (const auto& [all, alike] : by_cost) {
      for (const auto& [key, own] : alike) work += own;
      if (work > most_work) break;
      for (const auto& [key, own] : alike) keys.push_back(key);
    }
    return keys;
  }

  /// Leaves what is worth a table. `computed`: what is computed in any case, and becomes what is.
  void sort_out(std::vector<ValueId>& outputs, Cone& computed) const {
    const auto no_number = std::ranges::partition(
        outputs, [&](ValueId value) { return at(value).type == Scalar::f32; });
    for (const ValueId value : no_number) groups_.add_cone(value, computed);
    outputs.erase(no_number.begin(), outputs.end());
    // What is computed makes others cheap, until nothing changes.
    const auto is_cheap = [&](ValueId value) {
      return cost(cone_of({value}), computed) <= least_cost;
    };
    for (auto cheap = std::ranges::find_if(outputs, is_cheap); cheap != outputs.end();
         cheap = std::ranges::find_if(outputs, is_cheap)) {
      groups_.add_cone(*cheap, computed);
      outputs.erase(cheap);
    }
  }

  std::optional<Looked> look_up(ValueId key, std::vector<ValueId> outputs) const {
    Cone computed;
    while (true) {
      sort_out(outputs, computed);
      const Cone looked = cone_of(outputs);
      const double saved = cost(looked, computed);
      if (saved < least_cost_of_tables(outputs.size()) + least_saving) return std::nullopt;
      const Sampler sampler(program_, cone_of(outputs), key, outputs);
      std::optional<Piecewise> fitted;
      const auto fit = [&](const Axis& axis) {
        auto made = fit_piecewise(axis, error_, [&](auto numbers) { return sampler.run(numbers); });
        if (made && (!fitted || !has_gaps(*made))) fitted = std::move(made);
      };
      const auto is_whole = [&] { return fitted && !has_gaps(*fitted); };
      const Range& range = groups_.range(key);
      const std::optional<ValueId> place = place_in(looked);
      fit(axis_of(range.low, range.high, most_cells, Axis::Along::number));
      if (place && !is_whole()) {
        if (const auto axis = given_axis(key, *place, computed)) fit(*axis);
      }
      if (!is_whole()) fit(axis_of(range.low, range.high, most_cells, Axis::Along::root));
      if (!fitted) return std::nullopt;
      const std::size_t before = outputs.size();
      // Again without those that no table is close to.
      std::size_t k = 0;
      std::erase_if(outputs, [&](ValueId value) {
        const bool is_far = fitted->functions[k++].empty();
        if (is_far) groups_.add_cone(value, computed);
        return is_far;
      });
      if (outputs.size() < before) continue;
      if (saved < fitted->cost() + least_saving) return std::nullopt;
      return Looked{key, std::move(outputs), std::move(*fitted), place.value_or(no_value)};
    }
  }

  static bool has_gaps(const Piecewise& fitted) {
    return std::ranges::any_of(fitted.functions, [](const auto& each) { return each.empty(); });
  }

  /// Of straight lines in equal cells.
  static double least_cost_of_tables(std::size_t functions) {
    return 6 + 3 * static_cast<double>(functions);
  }

  /// A value whose whole part is looked at, as an index of another table is made: there functions
  /// of it have their corners. Of several the one with the most cells, whichever came first.
  std::optional<ValueId> place_in(const Cone& cone) const {
    std::optional<ValueId> found;
    const auto rank = [&](ValueId of) {
      return std::pair(groups_.range(of).high, -cost(cone_of({of}), {}));
    };
    for (const ValueId i : cone) {
      if (at(i).op != Op::floor) continue;
      const ValueId of = at(i).operands[0];
      const Range& range = groups_.range(of);
      if (!cone.contains(of) || !range.is_bounded() || range.high > most_cells) continue;
      if (!found || rank(of) > rank(*found)) found = of;
    }
    return found;
  }

  /// Its cells; nothing where it does not grow with the number.
  std::optional<Axis> given_axis(ValueId key, ValueId place, const Cone& computed) const {
    const Range& range = groups_.range(key);
    const Sampler sampler(program_, cone_of({place}), key, {place});
    const auto places = [&](std::span<const float> numbers) {
      auto all = sampler.run(numbers);
      return all.empty() ? std::vector<double>{} : std::move(all.front());
    };
    const double ends_at = groups_.range(place).high;
    Axis axis{.low = range.low,
              .high = range.high,
              .cells = static_cast<int>(std::ceil(ends_at * (1 - 1e-5))),
              .along = Axis::Along::given,
              .cost = cost(cone_of({place}), computed)};
    auto numbers = numbers_of_places(axis, places);
    if (!numbers) return std::nullopt;
    axis.numbers = std::move(*numbers);
    return axis;
  }

  const Program& program_;
  Groups groups_;
  double error_;
};

}  // namespace

double operation_cost(Op op) {
  if (is_transcendental(op)) return 25;
  switch (op) {
    case Op::constant: return 0;
    case Op::div: return 6;
    case Op::sqrt: return 8;
    case Op::table: return 4;
    default: return 1;
  }
}

Program tabulate(const Program& program, double error) {
  Program marked = program;
  mark_varying(marked);
  const Tabulator tabulator(marked, error);
  const std::vector<Looked> all = tabulator.run();
  if (all.empty()) return program;
  const Function& entry = marked.entry();
  std::unordered_map<ValueId, std::pair<const Looked*, std::size_t>> looked;
  std::unordered_map<ValueId, Ref> keys;
  for (const Looked& group : all) {
    keys[group.key] = {};
    for (std::size_t k = 0; k < group.values.size(); ++k) looked[group.values[k]] = {&group, k};
  }
  const auto place_of = [&](Recorder& recorder, const Looked& group) {
    const Ref number = keys.at(group.key);
    const Axis& axis = group.fitted.axis;
    if (axis.along != Axis::Along::given) return record_place(recorder, axis, number);
    Cone cone;
    tabulator.groups().add_cone(group.place, cone);
    return record_again(recorder, entry, cone, group.key, number).at(group.place);
  };
  const auto replace = [&](Recorder& recorder, const Instruction& instruction,
                           std::span<const Ref> operands) -> std::optional<Ref> {
    const auto value = static_cast<ValueId>(&instruction - entry.code.data());
    if (&instruction < entry.code.data() || value >= entry.code.size()) return std::nullopt;
    if (const auto found = looked.find(value); found != looked.end()) {
      const auto& [group, function] = found->second;
      return record_piecewise(recorder, group->fitted, function, place_of(recorder, *group));
    }
    const auto key = keys.find(value);
    if (key == keys.end()) return std::nullopt;
    return key->second = recorder.emit(instruction.op, operands, instruction.imm);
  };
  Program made = transform(marked, replace);
  mark_varying(made);
  return made;
}

}  // namespace nacre
