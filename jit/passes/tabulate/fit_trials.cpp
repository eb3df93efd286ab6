#include "jit/passes/tabulate/fit_trials.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "jit/passes/expand_math.h"
#include "jit/passes/tabulate/fit.h"
#include "runtime/interpreter/interpreter.h"

namespace nacre {

namespace {

constexpr unsigned trials = 8;

/// Of colours and weights, roughnesses, indices of refraction.
std::vector<std::uint32_t> on_trial(const Program& program, unsigned trial) {
  constexpr std::array numbers{0.3f, 1.5f, 0.8f, 0.1f, 0.5f, 0.9f};
  std::vector<std::uint32_t> bits;
  for (unsigned i = 0; i < program.parameters.size(); ++i) {
    const unsigned at = ((i * 7 + trial * (2 * i + 1)) * 0x9e3779b9u) >> 16;
    const bool is_number = program.parameters[i].type == Scalar::f32;
    bits.push_back(is_number ? std::bit_cast<std::uint32_t>(numbers[at % numbers.size()]) : at % 2);
  }
  return bits;
}

/// Of a number that changes by less a fit tells nothing.
bool is_constant(std::span<const float> values) {
  const auto [least, most] = std::ranges::minmax(values);
  return !(most - least > 0.01f * std::max(std::abs(least), std::abs(most)));
}

}  // namespace

std::vector<bool> close_on_trials(const Fit& fit, const Program& maker) {
  const auto kernel =
      make_interpreter(expand_math(maker, Accuracy::standard, std::size_t{1} << 31));
  std::vector<int> close(maker.outputs.size(), 0), all(maker.outputs.size(), 0);
  std::array<float, std::size_t{Fit::cells} * Fit::coefficients> rows;
  for (unsigned trial = 0; trial < trials; ++trial) {
    const auto functions = fit_values(fit, *kernel, on_trial(maker, trial));
    for (std::size_t k = 0; k < functions.size(); ++k) {
      if (is_constant(functions[k])) continue;
      ++all[k];
      if (fit_cells(fit, functions[k], rows)) ++close[k];
    }
  }
  std::vector<bool> are_close;
  for (std::size_t k = 0; k < all.size(); ++k) {
    are_close.push_back(2 * close[k] > all[k]);
  }
  return are_close;
}

}  // namespace nacre
