#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "jit/passes/tabulate/groups.h"
#include "jit/passes/tabulate/piecewise.h"

namespace nacre {

/// What an operation costs, in additions: a weight to choose by. Transcendental functions are
/// polynomials, and shorter ones where tables may be off by more.
double operation_cost(Op op, double error);

/// What the outputs of a group are computed from, each value by its place in an order in which
/// operands come first.
class Computation {
 public:
  /// `error`: see operation_cost().
  Computation(const Program& program, const Groups& groups, const std::vector<ValueId>& outputs,
              double error);

  std::size_t size() const { return values_.size(); }
  ValueId value(std::size_t i) const { return values_[i]; }
  const std::vector<ValueId>& values() const { return values_; }
  std::size_t at(ValueId value) const;
  bool has(ValueId value) const;
  bool is_number(std::size_t i) const { return is_number_[i]; }
  /// Computed once for all points.
  bool is_of_parameters(std::size_t i) const { return is_of_parameters_[i]; }
  const std::vector<std::size_t>& operands(std::size_t i) const { return operands_[i]; }
  double cost(std::size_t i) const { return costs_[i]; }
  double cost() const;

  /// What `i` is computed from, itself among it, down to what is in `done`.
  std::vector<std::size_t> below(std::size_t i, const std::vector<bool>& done) const;
  double cost_of(const std::vector<std::size_t>& all) const;
  /// What depends on `i` alone, in order.
  std::vector<std::size_t> of_alone(std::size_t i) const;

 private:
  std::vector<ValueId> values_;
  std::vector<bool> is_number_;
  std::vector<bool> is_of_parameters_;
  std::vector<std::vector<std::size_t>> operands_;
  std::vector<double> costs_;
  std::vector<bool> has_key_;
};

/// Tables of a group's values along one axis.
struct Tables {
  Piecewise fitted;
  ValueId key;                        ///< Of the group, or of what depends on one of its values.
  ValueId place;                      ///< Of an axis that is given by a value of the group.
  std::vector<std::size_t> function;  ///< Of each value of the Computation; `none`: none.
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  bool has(std::size_t i) const {
    return function[i] != none && !fitted.functions[function[i]].empty();
  }
  double cost(std::size_t i) const { return fitted.cost_of(function[i]); }
};

/// Which values are looked up, and in which tables; all others that outputs need are computed.
struct Cover {
  std::vector<std::optional<std::size_t>> tables;  ///< By value: one of those chosen from.
  double cost = 0;
};

/// The cover of least cost that is found from the outputs downwards with tables of that selection.
/// `computed`: outputs that must not come of tables, nor anything that they are computed from.
Cover cover(const Computation& computation, const std::vector<std::size_t>& outputs,
            const std::vector<bool>& computed, const std::vector<Tables>& all,
            const std::vector<std::size_t>& chosen);

}  // namespace nacre
