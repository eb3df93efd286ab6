#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "jit/passes/tabulate/axis.h"

namespace nacre {

/// Functions of one number, each as polynomials in the cells of one axis: as tables that CPUs keep
/// in registers.
struct Piecewise {
  Axis axis;
  /// A function: the coefficients of degree 0 in each cell, then those of degree 1, ...
  std::vector<std::vector<std::vector<float>>> functions;

  /// Operations that having them all takes, as operation_cost() counts.
  double cost() const;
};

/// Values of all functions at some numbers: [function][number]. Empty: they cannot be had.
using Sampled = std::function<std::vector<std::vector<double>>(std::span<const float> numbers)>;

/// The cheapest that is nowhere further off than `error` times the larger of a function's value
/// and a hundredth of its largest, looked at in Axis::parts places of each cell: along an axis, or,
/// if its cells are an even number of equal ones, along the one that has half as many. A function
/// that none is as close to is left empty; nothing where all are.
std::optional<Piecewise> fit_piecewise(const Axis& axis, double error, const Sampled& sampled);

/// Values of one of its functions, at a place of its axis.
Ref record_piecewise(Recorder& recorder, const Piecewise& fitted, std::size_t function, Ref place);

}  // namespace nacre
