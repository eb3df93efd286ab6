#include "jit/passes/tabulate/plan.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "jit/passes/tabulate/cover.h"
#include "jit/passes/tabulate/fit_trials.h"
#include "jit/passes/tabulate/sampler.h"

namespace nacre {

namespace {

/// As many entries as CPUs keep in registers.
constexpr int most_cells = 32;
/// Axes of a group that its own values give: the more lobes, the more tables of theirs.
constexpr std::size_t most_places = 4;
constexpr std::size_t most_inner_keys = 8;
/// Of larger groups outputs alone are looked up.
constexpr std::size_t most_values = 2000;

class Planner {
 public:
  Planner(const Program& program, const Groups& groups, ValueId key, double error)
      : program_(program),
        groups_(groups),
        key_(key),
        error_(error),
        computation_(program, groups, groups.outputs().at(key), error),
        computed_(computation_.size(), false) {
    for (const ValueId output : groups.outputs().at(key)) {
      outputs_.push_back(computation_.at(output));
      if (!computation_.is_number(outputs_.back())) compute(outputs_.back());
    }
    find_candidates();
  }

  std::vector<Looked> run() {
    find_tables();
    while (!tables_.empty()) {
      const std::vector<Looked> plan = cheapest();
      // Each fit is looked at when its parameters are known; what becomes of it here is not.
      if (plan.empty() || groups_.has_parameters()) return plan;
      const std::vector<std::size_t> far = outputs_too_far(plan);
      if (far.empty()) return plan;
      for (const std::size_t output : far) compute(output);
    }
    return {};
  }

 private:
  using Sampled = std::vector<std::vector<double>>;

  const Instruction& at(ValueId value) const { return program_.entry().code[value]; }

  /// From now on, and what it is computed from.
  void compute(std::size_t i) {
    for (const std::size_t each : computation_.below(i, std::vector<bool>(computed_.size()))) {
      computed_[each] = true;
    }
  }

  /// Numbers that may be looked up: all that take more operations than a table does.
  void find_candidates() {
    const std::vector<bool> nothing(computation_.size());
    for (std::size_t i = 0; i < computation_.size(); ++i) {
      if (computed_[i] || !computation_.is_number(i)) continue;
      if (computation_.is_of_parameters(i)) continue;
      const bool is_output = std::ranges::find(outputs_, i) != outputs_.end();
      if (!is_output && computation_.size() > most_values) continue;
      if (computation_.cost_of(computation_.below(i, nothing)) < least_cost_of_a_table) continue;
      candidates_.push_back(i);
    }
  }

  std::vector<ValueId> values_of(const std::vector<std::size_t>& all) const {
    std::vector<ValueId> values;
    for (const std::size_t i : all) values.push_back(computation_.value(i));
    return values;
  }
  Cone cone_of(ValueId value) const {
    Cone cone;
    groups_.add_cone(value, cone);
    return cone;
  }

  void find_tables() {
    add_tables(key_, candidates_, places());
    for (const std::size_t inner : inner_keys()) {
      std::vector<std::size_t> of_it;
      std::ranges::set_intersection(computation_.of_alone(inner), candidates_,
                                    std::back_inserter(of_it));
      add_tables(computation_.value(inner), of_it, {});
    }
  }

  /// Of what depends on that number, along its own axes and those of places.
  void add_tables(ValueId key, const std::vector<std::size_t>& all,
                  const std::vector<ValueId>& places) {
    if (all.empty()) return;
    const std::vector<ValueId> values = values_of(all);
    const Cone cone = groups_.cone_of(values, key);
    if (groups_.has_parameters()) {
      add_fits(key, all, program_of(program_, cone, key, values));
      return;
    }
    const Sampler sampler(program_, cone, key, values);
    const auto add = [&](const Axis& axis, ValueId place) {
      for (Piecewise& fitted :
           fit_piecewise(axis, error_, [&](auto numbers) { return sampler.run(numbers); })) {
        add_table(std::move(fitted), key, place, all);
      }
    };
    const Range& range = groups_.range(key);
    add(axis_of(range.low, range.high, most_cells, Axis::Along::number), no_value);
    for (const ValueId place : places) {
      const Axis axis = given_axis(place);
      if (const auto whole = with_numbers(axis, place)) add(*whole, place);
      const Axis dense = with_dense_end(axis, most_cells);
      if (dense.cells == axis.cells) continue;
      if (const auto whole = with_numbers(dense, place)) add(*whole, place);
    }
    add(axis_of(range.low, range.high, most_cells, Axis::Along::root), no_value);
  }

  void add_table(Piecewise fitted, ValueId key, ValueId place,
                 const std::vector<std::size_t>& all) {
    Tables tables{std::move(fitted), key, place,
                  std::vector<std::size_t>(computation_.size(), Tables::none)};
    for (std::size_t k = 0; k < all.size(); ++k) tables.function[all[k]] = k;
    tables_.push_back(std::move(tables));
  }

  /// What fits, in as many cells and by as many coefficients whatever the parameters.
  void add_fits(ValueId key, const std::vector<std::size_t>& all, const Program& maker) {
    const Range& range = groups_.range(key);
    // Far from 0 a float has too few digits to say where it is between the two.
    constexpr double farthest = 8;
    const double width = range.high - range.low;
    if (std::max(std::abs(range.low), std::abs(range.high)) > farthest * width) return;
    const Axis axis = axis_of(range.low, range.high, Fit::cells, Axis::Along::root);
    const Fit fit{.maker = nullptr,
                  .low = static_cast<float>(range.low),
                  .high = static_cast<float>(range.high),
                  .error = static_cast<float>(error_of_floats * error_)};
    const std::vector<bool> are_close = close_on_trials(fit, maker);
    Piecewise found{axis, {}};
    for (std::size_t k = 0; k < all.size(); ++k) {
      found.functions.emplace_back(are_close[k] ? Fit::coefficients : 0,
                                   std::vector<float>(Fit::cells));
    }
    add_table(std::move(found), key, no_value, all);
  }

  /// Numbers with a corner or a step in the middle of a cell, of which something is smooth: those
  /// that most depends on.
  std::vector<std::size_t> inner_keys() const {
    std::map<double, std::vector<std::size_t>, std::greater<>> by_cost;
    if (computation_.size() > most_values) return {};
    for (std::size_t i = 0; i < computation_.size(); ++i) {
      const Op op = at(computation_.value(i)).op;
      if (op != Op::min && op != Op::max && op != Op::select) continue;
      if (computed_[i] || computation_.is_of_parameters(i)) continue;
      if (!groups_.is_bounded(computation_.value(i))) continue;
      const double cost = computation_.cost_of(computation_.of_alone(i));
      if (cost < least_cost_of_a_table + least_saving_of(groups_)) continue;
      by_cost[cost].push_back(i);
    }
    std::vector<std::size_t> found;
    for (const auto& [cost, alike] : by_cost) {
      if (found.size() + alike.size() > most_inner_keys) break;
      found.insert(found.end(), alike.begin(), alike.end());
    }
    return found;
  }

  /// Values whose whole part is looked at, as an index of another table is made: there functions
  /// of it have their corners. Those of the most cells first, and then the cheapest.
  std::vector<ValueId> places() const {
    if (groups_.has_parameters()) return {};  // They would differ from parameters to parameters.
    std::map<std::pair<double, double>, std::vector<ValueId>> ranked;
    for (const ValueId i : computation_.values()) {
      if (at(i).op != Op::floor) continue;
      const ValueId of = at(i).operands[0];
      const Range& range = groups_.range(of);
      if (!computation_.has(of) || !range.is_bounded() || range.high > most_cells) continue;
      std::vector<ValueId>& alike = ranked[{-range.high, cost_of(of)}];
      if (std::ranges::find(alike, of) == alike.end()) alike.push_back(of);
    }
    std::vector<ValueId> found;
    for (const auto& [rank, alike] : ranked) {
      found.insert(found.end(), alike.begin(), alike.end());
    }
    if (found.size() > most_places) found.resize(most_places);
    return found;
  }
  double cost_of(ValueId value) const {
    return computation_.cost_of(
        computation_.below(computation_.at(value), std::vector<bool>(computation_.size())));
  }

  /// Its cells.
  Axis given_axis(ValueId place) const {
    const Range& range = groups_.range(key_);
    const double ends_at = groups_.range(place).high;
    return {.low = range.low,
            .high = range.high,
            .cells = static_cast<int>(std::ceil(ends_at * (1 - 1e-5))),
            .along = Axis::Along::given,
            .cost = cost_of(place)};
  }

  /// Nothing where the place does not grow with the number.
  std::optional<Axis> with_numbers(Axis axis, ValueId place) const {
    const Sampler sampler(program_, cone_of(place), key_, {place});
    const auto places = [&](std::span<const float> numbers) {
      auto all = sampler.run(numbers);
      return all.empty() ? std::vector<double>{} : std::move(all.front());
    };
    auto numbers = numbers_of_places(axis, places);
    if (!numbers) return std::nullopt;
    axis.numbers = std::move(*numbers);
    return axis;
  }

  /// By the tables that save most, then those that save most beside them, and so on.
  std::vector<Looked> cheapest() const {
    std::vector<std::size_t> chosen;
    Cover best{.tables = std::vector<std::optional<std::size_t>>(computation_.size()),
               .cost = computation_.cost()};
    for (bool has_better = true; has_better;) {
      has_better = false;
      const double most = best.cost - least_saving_of(groups_);
      const std::vector<std::size_t> before = chosen;
      for (std::size_t k = 0; k < tables_.size(); ++k) {
        if (std::ranges::find(before, k) != before.end()) continue;
        std::vector<std::size_t> with = before;
        with.push_back(k);
        Cover cover = nacre::cover(computation_, outputs_, computed_, tables_, with);
        if (cover.cost > most || (has_better && cover.cost >= best.cost)) continue;
        best = std::move(cover);
        chosen = with;
        has_better = true;
      }
    }
    std::vector<Looked> plan;
    for (const std::size_t k : chosen) {
      const Tables& tables = tables_[k];
      Looked looked{tables.key, {}, {tables.fitted.axis, {}}, tables.place};
      for (std::size_t i = 0; i < computation_.size(); ++i) {
        if (best.tables[i] != k) continue;
        looked.values.push_back(computation_.value(i));
        looked.fitted.functions.push_back(tables.fitted.functions[tables.function[i]]);
      }
      if (!looked.values.empty()) plan.push_back(std::move(looked));
    }
    return plan;
  }

  /// Outputs that are computed from what is looked up, or looked up by such a number, and magnify
  /// its error.
  std::vector<std::size_t> outputs_too_far(const std::vector<Looked>& plan) const {
    std::vector<std::size_t> numbers;
    for (const std::size_t output : outputs_) {
      const bool is_looked_up = std::ranges::any_of(plan, [&](const Looked& looked) {
        return looked.key == key_ &&
               std::ranges::count(looked.values, computation_.value(output)) > 0;
      });
      if (!computed_[output] && !is_looked_up) numbers.push_back(output);
    }
    if (numbers.empty()) return {};
    const std::vector<ValueId> values = values_of(numbers);
    Cone cone;
    for (const ValueId value : values) groups_.add_cone(value, cone);
    const Sampler exact(program_, cone, key_, values);
    const Sampler made(program_, groups_, cone, key_, values, plan);
    std::vector<bool> is_far(numbers.size(), false);
    const Range& range = groups_.range(key_);
    for (const auto along : {Axis::Along::number, Axis::Along::root}) {
      const Axis axis = axis_of(range.low, range.high, most_cells, along);
      const Sampled a = exact.run(axis.numbers);
      const Sampled b = made.run(axis.numbers);
      for (std::size_t k = 0; k < numbers.size(); ++k) {
        is_far[k] = is_far[k] || a.empty() || b.empty() || !is_close(b[k], a[k]);
      }
    }
    std::vector<std::size_t> far;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      if (is_far[k]) far.push_back(numbers[k]);
    }
    return far;
  }
  bool is_close(const std::vector<double>& found, const std::vector<double>& exact) const {
    double peak = 0;
    for (const double v : exact) peak = std::max(peak, std::abs(v));
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const double least = std::max(std::abs(exact[i]), floor_of_peak * peak);
      // Written so that what is no number is not close.
      if (!(std::abs(found[i] - exact[i]) <= 1.1 * error_ * least)) return false;
    }
    return true;
  }

  const Program& program_;
  const Groups& groups_;
  ValueId key_;
  double error_;
  Computation computation_;
  std::vector<std::size_t> outputs_;
  std::vector<bool> computed_;
  std::vector<std::size_t> candidates_;
  std::vector<Tables> tables_;
};

}  // namespace

Ref record_looked(Recorder& recorder, const Program& program, const Groups& groups,
                  const Looked& looked, std::size_t function, Ref number) {
  const auto place = [&] {
    const Axis& axis = looked.fitted.axis;
    if (axis.along != Axis::Along::given) return record_place(recorder, axis, number);
    Cone cone;
    groups.add_cone(looked.place, cone);
    const auto again = record_again(recorder, program.entry(), cone, looked.key, number);
    return record_dense_place(recorder, axis, again.at(looked.place));
  };
  return record_piecewise(recorder, looked.fitted, function, place());
}

std::vector<Looked> plan_group(const Program& program, const Groups& groups, ValueId key,
                               double error) {
  return Planner(program, groups, key, error).run();
}

}  // namespace nacre
