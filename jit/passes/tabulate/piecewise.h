#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "jit/passes/tabulate/axis.h"

namespace nacre {

/// Errors are relative to a value, or to that share of the function's largest where it is more.
inline constexpr double floor_of_peak = 0.01;

/// In [0, 1], by the coefficients of degree 0 to 3.
using Polynomial = std::array<double, 4>;
/// Through values at 0, 1/4, 3/4 and 1, nearly Chebyshev's.
Polynomial cubic_through(double f0, double a, double b, double f1);
double value_at(const Polynomial& p, double x);

/// Functions of one number, each as polynomials in the cells of one axis: as tables that CPUs keep
/// in registers.
struct Piecewise {
  Axis axis;
  /// A function: the coefficients of degree 0 in each cell, then those of degree 1, ...
  std::vector<std::vector<std::vector<float>>> functions;

  /// Operations, as operation_cost() counts them: to find a number's cell, and then to have one of
  /// the functions.
  double cost_of_cell() const { return axis.cost + 5; }
  double cost_of(std::size_t function) const;
};

/// Values of all functions at some numbers: [function][number]. Empty: they cannot be had.
using Sampled = std::function<std::vector<std::vector<double>>(std::span<const float> numbers)>;

/// Those along an axis, and, if its cells are an even number of equal ones, along the one that has
/// half as many: of the lowest degree that is nowhere further off than `error` times the larger of
/// a function's value and a hundredth of its largest, looked at in Axis::parts places of each cell.
/// A function that none is as close to is left empty; an axis where all are is left out.
std::vector<Piecewise> fit_piecewise(const Axis& axis, double error, const Sampled& sampled);

/// Values of one of its functions, at a place of its axis.
Ref record_piecewise(Recorder& recorder, const Piecewise& fitted, std::size_t function, Ref place);

}  // namespace nacre
