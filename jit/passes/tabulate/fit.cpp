#include "jit/passes/tabulate/fit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "jit/passes/tabulate/piecewise.h"

namespace nacre {

namespace {

/// Looked at in so many equal parts of each cell.
constexpr std::size_t parts = 8;

std::vector<float> numbers_of(const Fit& fit) {
  std::vector<float> numbers;
  constexpr std::size_t last = Fit::cells * parts;
  const double width = double{fit.high} - fit.low;
  for (std::size_t i = 0; i <= last; ++i) {
    const double share = static_cast<double>(i) / last;
    numbers.push_back(static_cast<float>(fit.low + width * share * share));
  }
  return numbers;
}

}  // namespace

std::vector<std::vector<float>> fit_values(const Fit& fit, const Kernel& maker,
                                           std::span<const std::uint32_t> parameters) {
  const std::vector<float> numbers = numbers_of(fit);
  const std::size_t count = numbers.size();
  std::vector<std::vector<float>> made(maker.program().outputs.size(), std::vector<float>(count));
  std::vector<void*> outputs;
  for (std::vector<float>& function : made) outputs.push_back(function.data());
  const void* const input = numbers.data();
  const KernelArguments arguments{
      .inputs = &input, .outputs = outputs.data(), .parameters = parameters.data(), .count = count};
  if (maker.run(arguments) != RunStatus::done) made.clear();
  return made;
}

bool fit_cells(const Fit& fit, std::span<const float> values, std::span<float> rows) {
  float peak = 0;
  for (const float value : values) {
    if (!std::isfinite(value)) return false;
    peak = std::max(peak, std::abs(value));
  }
  const float floor = static_cast<float>(floor_of_peak) * peak;
  for (std::size_t cell = 0; cell < Fit::cells; ++cell) {
    const auto here = values.subspan(cell * parts, parts + 1);
    Polynomial p = cubic_through(here[0], here[parts / 4], here[3 * parts / 4], here[parts]);
    for (std::size_t k = 0; k < p.size(); ++k) {
      const auto number = static_cast<float>(p[k]);
      if (!std::isfinite(number)) return false;
      // What kernels read, who take what is denormal as 0, is what is looked at.
      p[k] = rows[k * Fit::cells + cell] = std::isnormal(number) ? number : 0.0f;
    }
    for (std::size_t k = 0; k <= parts; ++k) {
      const double off = std::abs(value_at(p, static_cast<double>(k) / parts) - here[k]);
      // Written so that what is no number is not close.
      if (!(off <= fit.error * std::max(std::abs(here[k]), floor))) return false;
    }
  }
  return true;
}

}  // namespace nacre
