#include "jit/passes/tabulate/piecewise.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "runtime/program/recorder.h"

namespace nacre {

namespace {

constexpr int parts = Axis::parts;
constexpr std::size_t degrees = 3;

/// A function in a cell, by its values in equal parts of that.
using Values = std::span<const double, parts + 1>;

/// Through as many of the values as it has coefficients, those at both ends among them: neighbours
/// meet.
Polynomial interpolate(Values values, std::size_t degree) {
  const double f0 = values[0], f1 = values[parts];
  switch (degree) {
    case 1: return {f0, f1 - f0, 0, 0};
    case 2: {
      const double middle = values[parts / 2];
      return {f0, 4 * middle - 3 * f0 - f1, 2 * f0 - 4 * middle + 2 * f1, 0};
    }
    default: return cubic_through(f0, values[parts / 4], values[3 * parts / 4], f1);
  }
}

/// Of the lowest degree that is close enough in all cells; empty if none is.
std::vector<std::vector<float>> fit(std::span<const double> values, std::size_t cells,
                                    double error) {
  const double peak =
      std::abs(*std::ranges::max_element(values, {}, [](double v) { return std::abs(v); }));
  const double floor = floor_of_peak * peak;
  for (std::size_t degree = 1; degree <= degrees; ++degree) {
    std::vector<std::vector<float>> coefficients(degree + 1, std::vector<float>(cells));
    bool is_close = true;
    for (std::size_t cell = 0; cell < cells && is_close; ++cell) {
      const Values here(values.data() + cell * parts, parts + 1);
      Polynomial p = interpolate(here, degree);
      for (std::size_t k = 0; k <= degree; ++k) {
        coefficients[k][cell] = static_cast<float>(p[k]);
        p[k] = coefficients[k][cell];
      }
      for (std::size_t k = 0; k <= parts; ++k) {
        const double off = std::abs(value_at(p, static_cast<double>(k) / parts) - here[k]);
        is_close = is_close && off <= error * std::max(std::abs(here[k]), floor);
      }
    }
    if (is_close) return coefficients;
  }
  return {};
}

using Functions = std::vector<std::vector<double>>;

/// All functions in so many cells of the axis.
std::optional<Piecewise> fit_cells(const Axis& axis, double error, const Functions& values) {
  Piecewise made{axis, {}};
  bool has_any = false;
  for (const std::vector<double>& of_one : values) {
    const bool is_finite = std::ranges::all_of(of_one, [](double v) { return std::isfinite(v); });
    made.functions.push_back(is_finite ? fit(of_one, static_cast<std::size_t>(axis.cells), error)
                                       : std::vector<std::vector<float>>{});
    has_any = has_any || !made.functions.back().empty();
  }
  return has_any ? std::optional(std::move(made)) : std::nullopt;
}

/// Every second of them.
Functions halved(const Functions& values) {
  Functions half;
  for (const std::vector<double>& of_one : values) {
    std::vector<double>& some = half.emplace_back();
    for (std::size_t i = 0; i < of_one.size(); i += 2) some.push_back(of_one[i]);
  }
  return half;
}

/// Whether a few cells say that there is nothing to be had: the first ones, where most happens.
bool is_hopeless(const Axis& axis, double error, const Sampled& sampled) {
  constexpr int few = 4;
  if (axis.cells <= 2 * few) return false;
  Axis first = axis;
  first.cells = few;
  first.numbers.resize(few * parts + 1);
  const Functions values = sampled(first.numbers);
  return values.empty() || !fit_cells(first, error, values);
}

}  // namespace

Polynomial cubic_through(double f0, double a, double b, double f1) {
  // Newton's divided differences.
  const double d1 = 4 * (a - f0), d2 = 2 * (b - a), d3 = 4 * (f1 - b);
  const double e1 = (d2 - d1) / 0.75, e2 = (d3 - d2) / 0.75;
  const double g = e2 - e1;
  // f0 + x (d1 + (x - 1/4) (e1 + (x - 3/4) g))
  return {f0, d1 - 0.25 * e1 + 0.1875 * g, e1 - g, g};
}

double value_at(const Polynomial& p, double x) { return p[0] + x * (p[1] + x * (p[2] + x * p[3])); }

double Piecewise::cost_of(std::size_t function) const {
  const double look_up = axis.cells > 16 ? 2 : 1;
  const auto count = static_cast<double>(functions[function].size());
  return count * look_up + count - 1;
}

std::vector<Piecewise> fit_piecewise(const Axis& axis, double error, const Sampled& sampled) {
  if (is_hopeless(axis, error, sampled)) return {};
  const Functions values = sampled(axis.numbers);
  if (values.empty()) return {};
  std::vector<Piecewise> found;
  if (auto whole = fit_cells(axis, error, values)) found.push_back(std::move(*whole));
  if (axis.along == Axis::Along::given || axis.cells % 2 != 0) return found;
  Axis coarse = axis;
  coarse.cells = axis.cells / 2;
  if (auto half = fit_cells(coarse, error, halved(values))) found.push_back(std::move(*half));
  return found;
}

Ref record_piecewise(Recorder& recorder, const Piecewise& fitted, std::size_t function, Ref place) {
  const auto emit = [&](Op op, std::initializer_list<Ref> operands, std::uint32_t imm = 0) {
    return recorder.emit(op, std::span(operands.begin(), operands.size()), imm);
  };
  const Ref last = Ref::literal(static_cast<float>(fitted.axis.cells - 1));
  Ref cell = emit(Op::min, {emit(Op::floor, {place}), last});
  // Rounding may lead below.
  if (fitted.axis.low != 0) cell = emit(Op::max, {cell, Ref::literal(0.0f)});
  const Ref within = emit(Op::sub, {place, cell});
  Ref index = emit(Op::f_to_i, {cell});
  // Changes nothing, and tells engines that the index needs no clamp.
  const auto cells = static_cast<std::uint32_t>(fitted.axis.cells);
  if (std::has_single_bit(cells)) {
    index = emit(Op::iand, {index, Ref::literal(static_cast<std::int32_t>(cells - 1))});
  }
  const auto& coefficients = fitted.functions[function];
  const auto coefficient = [&](std::size_t degree) {
    return emit(Op::table, {index}, recorder.table("tabulated", coefficients[degree]));
  };
  Ref value = coefficient(coefficients.size() - 1);
  for (std::size_t k = coefficients.size() - 1; k-- > 0;) {
    value = emit(Op::fma, {value, within, coefficient(k)});
  }
  return value;
}

}  // namespace nacre
