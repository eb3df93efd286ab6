#include "jit/passes/tabulate/fit_parameters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "jit/passes/tabulate/fit_trials.h"
#include "jit/passes/tabulate/groups.h"
#include "jit/passes/tabulate/piecewise.h"
#include "jit/passes/tabulate/plan.h"
#include "jit/passes/tabulate/sampler.h"
#include "runtime/program/recorder.h"
#include "runtime/program/region.h"
#include "runtime/program/transform.h"

namespace nacre {

namespace {

Ref literal(double value) { return Ref::literal(static_cast<float>(value)); }

/// Values that are read together, where the first of them stands.
struct Place {
  const Looked* looked = nullptr;
  std::vector<ValueId> values{};
  Cone cone{};  ///< What computes them.
  Fit fit{};
  std::uint32_t number = 0;  ///< Of the fit.
  std::vector<Ref> made{};
};

class Fitting {
 public:
  Fitting(const Program& program, double error, std::vector<bool> slots)
      : program_(program),
        marked_(program),
        error_(error),
        groups_(mark(marked_), std::move(slots)) {}

  Program run() {
    plan_ = plan_all(marked_, groups_, error_);
    find_places();
    // Which come first is no reason to have some of them.
    if (marked_.fits.size() > Fit::most) return program_;
    if (places_.empty()) return marked_;
    const auto replace = [this](Recorder& recorder, const Instruction& instruction,
                                std::span<const Ref> operands) {
      return replacement(recorder, instruction, operands);
    };
    Program made = transform(marked_, replace);
    mark_varying(made);
    return made;
  }

 private:
  static const Program& mark(Program& program) {
    mark_varying(program);
    return program;
  }

  /// The looked-up values of each region by themselves: one that no lane enters costs nothing.
  void find_places() {
    std::unordered_map<ValueId, const Looked*> looked;
    for (const Looked& each : plan_) {
      for (const ValueId value : each.values) looked[value] = &each;
    }
    std::map<std::pair<ValueId, const Looked*>, Place> found;
    std::vector<ValueId> regions{no_value};
    const std::vector<Instruction>& code = marked_.entry().code;
    for (ValueId id = 0; id < code.size(); ++id) {
      if (opens_region(code[id].op)) regions.push_back(id);
      if (closes_region(code[id].op)) regions.pop_back();
      const auto group = looked.find(id);
      if (group == looked.end()) continue;
      Place& place = found[{regions.back(), group->second}];
      place.looked = group->second;
      place.values.push_back(id);
    }
    std::vector<Place> all;
    for (auto& [key, place] : found) all.push_back(std::move(place));
    std::ranges::sort(all, {}, [](const Place& place) { return place.values.front(); });
    for (Place& place : all) add(std::move(place));
    for (Place& place : places_) {
      for (std::size_t k = 0; k < place.values.size(); ++k)
        place_of_[place.values[k]] = {&place, k};
      keys_[place.looked->key] = {};
    }
  }

  void add(Place place) {
    place.cone = groups_.cone_of(place.values, place.looked->key);
    Program maker = program_of(marked_, place.cone, place.looked->key, place.values);
    // tabulate() has been there.
    if (maker.parameters.empty()) return;
    maker.origins = {""};
    for (Function& function : maker.functions) {
      for (Instruction& instruction : function.code) instruction.origin = 0;
    }
    std::vector<std::uint32_t> slots;
    for (ParameterSlot& slot : maker.parameters) {
      const auto found = std::ranges::find(marked_.parameters, slot.name, &ParameterSlot::name);
      slots.push_back(static_cast<std::uint32_t>(found - marked_.parameters.begin()));
      // Code is shared by Programs that differ in such things.
      slot = {std::to_string(slots.back()), slot.type, 0};
    }
    const Axis& axis = place.looked->fitted.axis;
    place.fit = {.maker = std::make_shared<const Program>(std::move(maker)),
                 .slots = std::move(slots),
                 .low = static_cast<float>(axis.low),
                 .high = static_cast<float>(axis.high),
                 .error = static_cast<float>(error_of_floats * error_)};
    give_number(place);
    places_.push_back(std::move(place));
  }

  /// Functions that are asked for of several numbers are fitted once.
  void give_number(Place& place) {
    const auto next = static_cast<std::uint32_t>(marked_.fits.size());
    const std::tuple key{to_string(*place.fit.maker), place.fit.low, place.fit.high};
    if (const auto known = numbers_.find(key); known != numbers_.end()) {
      place.number = known->second;
      place.fit = marked_.fits[place.number];
      return;
    }
    place.number = numbers_[key] = next;
    if (marked_.fitted_rows == 0) marked_.fitted_rows = Fit::first_rows;
    place.fit.row = marked_.fitted_rows;
    marked_.fitted_rows +=
        Fit::coefficients * static_cast<std::uint32_t>(place.fit.maker->outputs.size());
    marked_.fits.push_back(place.fit);
  }

  std::optional<Ref> replacement(Recorder& recorder, const Instruction& instruction,
                                 std::span<const Ref> operands) {
    const std::vector<Instruction>& code = marked_.entry().code;
    const auto value = static_cast<ValueId>(&instruction - code.data());
    if (&instruction < code.data() || value >= code.size()) return std::nullopt;
    const auto key = keys_.find(value);
    std::optional<Ref> made;
    if (const auto found = place_of_.find(value); found != place_of_.end()) {
      const auto& [place, k] = found->second;
      if (place->made.empty()) make(recorder, *place);
      made = place->made[k];
    } else if (key != keys_.end()) {
      made = recorder.emit(instruction.op, operands, instruction.imm);
    }
    if (key != keys_.end()) key->second = *made;
    return made;
  }

  /// Reads them where they are close, and computes them where they are not.
  void make(Recorder& recorder, Place& place) {
    const Ref number = keys_.at(place.looked->key);
    const Ref one = recorder.emit(
        Op::fitted, std::array{Ref::literal(static_cast<std::int32_t>(place.number % Fit::cells))},
        place.number / Fit::cells);
    const Ref is_close = recorder.emit(Op::lt, std::array{literal(0), one});
    recorder.begin_if(is_close);
    std::vector<Ref> values = read(recorder, place, number);
    for (Ref& value : values) value = recorder.merge(value, literal(0));
    recorder.end_if();
    recorder.begin_if(recorder.emit(Op::bnot, std::array{is_close}));
    const Refs again =
        record_again(recorder, marked_.entry(), place.cone, place.looked->key, number);
    for (std::size_t k = 0; k < values.size(); ++k) {
      place.made.push_back(recorder.merge(again.at(place.values[k]), values[k]));
    }
    recorder.end_if();
  }

  std::vector<Ref> read(Recorder& recorder, const Place& place, Ref number) const {
    const auto emit = [&](Op op, std::initializer_list<Ref> operands, std::uint32_t imm = 0) {
      return recorder.emit(op, std::span(operands.begin(), operands.size()), imm);
    };
    const Ref at = record_place(recorder, place.looked->fitted.axis, number);
    const Ref last = Ref::literal(static_cast<float>(Fit::cells - 1));
    const Ref cell = emit(Op::min, {emit(Op::floor, {at}), last});
    const Ref within = emit(Op::sub, {at, cell});
    const Ref index = emit(Op::f_to_i, {cell});
    std::vector<Ref> values;
    std::uint32_t row = place.fit.row;
    for (const ValueId id : place.values) {
      Ref value = emit(Op::fitted, {index}, row + Fit::coefficients - 1);
      for (std::uint32_t k = Fit::coefficients - 1; k-- > 0;) {
        value = emit(Op::fma, {value, within, emit(Op::fitted, {index}, row + k)});
      }
      row += Fit::coefficients;
      // What comes behind may count on what the value is known to be.
      const Range& range = groups_.range(id);
      if (std::isfinite(range.low)) value = emit(Op::max, {value, literal(range.low)});
      if (std::isfinite(range.high)) value = emit(Op::min, {value, literal(range.high)});
      values.push_back(value);
    }
    return values;
  }

  const Program& program_;
  Program marked_;
  double error_;
  Groups groups_;
  std::vector<Looked> plan_;
  std::vector<Place> places_;
  std::map<std::tuple<std::string, float, float>, std::uint32_t> numbers_;
  std::unordered_map<ValueId, std::pair<Place*, std::size_t>> place_of_;
  std::unordered_map<ValueId, Ref> keys_;
};

}  // namespace

Program fit_parameters(const Program& program, double error, std::vector<bool> slots) {
  return Fitting(program, error, std::move(slots)).run();
}

}  // namespace nacre
