#include "jit/passes/tabulate/tabulate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "jit/passes/range.h"
#include "jit/passes/tabulate/piecewise.h"
#include "runtime/program/recorder.h"
#include "runtime/program/slice.h"
#include "runtime/program/transform.h"
#include "runtime/reference/reference.h"

namespace nacre {

namespace {

/// What tables save of a group must be more than that, in operations.
constexpr double least_saving = 12;
/// A value that costs no more beside others of its group is computed.
constexpr double least_cost = 8;
/// Wider ranges have no cells worth the name.
constexpr double widest_range = 64;
/// As many entries as CPUs keep in registers.
constexpr double most_cells = 32;

bool is_pure(Op op) {
  switch (op) {
    case Op::constant:
    case Op::parameter:
    case Op::input:
    case Op::argument:
    case Op::texel:
    case Op::texture_call:
    case Op::result:
    case Op::call:
    case Op::keep:
    case Op::ddx: return false;
    default: return !is_structural(op);
  }
}

/// Values of the entry by what they depend on.
class Groups {
 public:
  explicit Groups(const Program& program)
      : code_(program.entry().code), function_(program.entry()), ranges_(ranges_of(program)) {
    for (ValueId i = 0; i < code_.size(); ++i) keys_.push_back(key_of(i));
    for (ValueId i = 0; i < code_.size(); ++i) note_uses(i);
  }

  /// Numbers that others depend on alone, bounded and different from point to point, and what of
  /// those others is used elsewhere: in order.
  const std::map<ValueId, std::vector<ValueId>>& outputs() const { return outputs_; }
  const Range& range(ValueId value) const { return ranges_[value]; }

  /// Adds what a value is computed from, but for its key; itself included.
  void add_cone(ValueId value, std::vector<bool>& cone) const {
    const ValueId key = keys_[value];
    if (key == value || key == no_value || cone[value]) return;
    cone[value] = true;
    for (const ValueId operand : function_.operands(code_[value])) add_cone(operand, cone);
  }

 private:
  /// Whether it may be the number of a table.
  bool is_bounded(ValueId value) const {
    const Range& range = ranges_[value];
    return is_pure(code_[value].op) && code_[value].type == Scalar::f32 && range.is_bounded() &&
           range.high > range.low && range.high - range.low <= widest_range;
  }

  /// The last value that everything of this one goes through, from which a bounded one may begin
  /// anew; no_value of constants.
  ValueId key_of(ValueId i) const {
    if (code_[i].op == Op::constant) return no_value;
    if (!is_pure(code_[i].op)) return i;
    ValueId key = no_value;
    for (const ValueId operand : function_.operands(code_[i])) {
      const ValueId of = keys_[operand];
      if (of == no_value || of == key) continue;
      if (key != no_value) return i;
      key = of;
    }
    if (key == no_value) return i;
    return is_bounded(i) && !is_bounded(key) ? i : key;
  }

  void note_uses(ValueId user) {
    for (const ValueId used : function_.operands(code_[user])) {
      const ValueId key = keys_[used];
      if (key == no_value || key == used || keys_[user] == key) continue;
      if (!is_bounded(key) || !code_[key].varying) continue;
      std::vector<ValueId>& list = outputs_[key];
      if (std::ranges::find(list, used) == list.end()) list.push_back(used);
    }
  }

  const std::vector<Instruction>& code_;
  const Function& function_;
  std::vector<Range> ranges_;
  std::vector<ValueId> keys_;
  std::map<ValueId, std::vector<ValueId>> outputs_;
};

/// A group that is looked up: its values, in the order of the functions.
struct Looked {
  ValueId key;
  std::vector<ValueId> values;
  Piecewise fitted;
  ValueId place;  ///< Of an axis that is given by a value of the group.
};

using Cone = std::vector<bool>;

/// Records the values of a group again: what is in `cone`, of another key.
std::unordered_map<ValueId, Ref> record_again(Recorder& recorder, const Function& function,
                                              const Cone& cone, ValueId key, Ref number) {
  std::unordered_map<ValueId, Ref> again{{key, number}};
  std::vector<Ref> operands;
  for (ValueId i = key + 1; i < cone.size(); ++i) {
    if (!cone[i]) continue;
    operands.clear();
    for (const ValueId operand : function.operands(function.code[i])) {
      const Instruction& found = function.code[operand];
      operands.push_back(found.op == Op::constant ? Ref{nullptr, found.imm, found.type}
                                                  : again.at(operand));
    }
    again[i] = recorder.emit(function.code[i].op, operands, function.code[i].imm);
  }
  return again;
}

class Tabulator {
 public:
  Tabulator(const Program& program, double error)
      : program_(program), groups_(program), error_(error) {}

  const Groups& groups() const { return groups_; }

  std::vector<Looked> run() const {
    std::vector<Looked> all;
    for (const auto& [key, outputs] : groups_.outputs()) {
      if (auto made = look_up(key, outputs)) all.push_back(std::move(*made));
    }
    return all;
  }

 private:
  const Instruction& at(ValueId value) const { return program_.entry().code[value]; }
  Cone no_cone() const { return Cone(program_.entry().code.size(), false); }
  Cone cone_of(const std::vector<ValueId>& values) const {
    Cone cone = no_cone();
    for (const ValueId value : values) groups_.add_cone(value, cone);
    return cone;
  }

  double cost(const Cone& cone, const Cone& less) const {
    double sum = 0;
    for (ValueId i = 0; i < cone.size(); ++i) {
      if (cone[i] && !less[i]) sum += operation_cost(at(i).op);
    }
    return sum;
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
    Cone computed = no_cone();
    while (true) {
      sort_out(outputs, computed);
      const Cone looked = cone_of(outputs);
      const double saved = cost(looked, computed);
      if (saved < least_saving) return std::nullopt;
      const auto sampled_outputs = [&](auto numbers) { return sampled(key, outputs, numbers); };
      const Range& range = groups_.range(key);
      std::vector<Axis> axes;
      for (const Axis::Along along : {Axis::Along::number, Axis::Along::root}) {
        for (const int cells : {16, 32}) {
          axes.push_back(axis_of(range.low, range.high, cells, along));
        }
      }
      const std::optional<ValueId> place = place_in(looked);
      if (place) {
        if (auto axis = given_axis(key, *place, computed)) axes.push_back(std::move(*axis));
      }
      auto fitted = fit_piecewise(axes, error_, sampled_outputs);
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

  /// A value whose whole part is looked at, as an index of another table is made: there functions
  /// of it have their corners.
  std::optional<ValueId> place_in(const Cone& cone) const {
    for (ValueId i = 0; i < cone.size(); ++i) {
      if (!cone[i] || at(i).op != Op::floor) continue;
      const ValueId of = at(i).operands[0];
      const Range& range = groups_.range(of);
      if (cone[of] && range.is_bounded() && range.high <= most_cells) return of;
    }
    return std::nullopt;
  }

  /// Its cells; nothing where it does not grow with the number.
  std::optional<Axis> given_axis(ValueId key, ValueId place, const Cone& computed) const {
    const Range& range = groups_.range(key);
    const auto places = [&](std::span<const float> numbers) {
      auto all = sampled(key, {place}, numbers);
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

  /// In double precision.
  std::vector<std::vector<double>> sampled(ValueId key, const std::vector<ValueId>& values,
                                           std::span<const float> numbers) const {
    Recorder recorder;
    recorder.adopt_interface(program_);
    const auto again = record_again(recorder, program_.entry(), cone_of(values), key,
                                    recorder.input("tabulated number", Scalar::f32));
    std::vector<SliceOutput> wanted;
    for (std::size_t k = 0; k < values.size(); ++k) {
      wanted.push_back({std::to_string(k), again.at(values[k])});
    }
    const auto kernel = make_reference(slice(recorder.program(), "tabulated", wanted));
    std::vector<std::vector<double>> found(values.size(), std::vector<double>(numbers.size()));
    std::vector<void*> columns;
    for (std::vector<double>& column : found) columns.push_back(column.data());
    const void* const input = numbers.data();
    KernelArguments arguments;
    arguments.inputs = &input;
    arguments.outputs = columns.data();
    arguments.count = numbers.size();
    if (kernel->run_double(arguments) != RunStatus::done) found.clear();
    return found;
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
    Cone cone(entry.code.size(), false);
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
