#include "jit/passes/tabulate/axis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "runtime/program/recorder.h"

namespace nacre {

namespace {

Ref literal(double value) { return Ref::literal(static_cast<float>(value)); }

}  // namespace

Axis axis_of(double low, double high, int cells, Axis::Along along) {
  const bool by_root = along == Axis::Along::root;
  Axis axis{.low = low, .high = high, .cells = cells, .along = along, .cost = by_root ? 10.0 : 1.0};
  const int last = cells * Axis::parts;
  for (int i = 0; i <= last; ++i) {
    const double share = static_cast<double>(i) / last;
    axis.numbers.push_back(
        static_cast<float>(low + (high - low) * (by_root ? share * share : share)));
  }
  return axis;
}

std::optional<std::vector<float>> numbers_of_places(const Axis& axis, const PlacesOf& places_of) {
  constexpr int grid = 4096;
  std::vector<float> numbers;
  for (int i = 0; i <= grid; ++i) {
    numbers.push_back(static_cast<float>(axis.low + (axis.high - axis.low) * i / grid));
  }
  const std::vector<double> places = places_of(numbers);
  const bool grows = std::ranges::adjacent_find(places, std::greater_equal{}) == places.end();
  constexpr double near = 1e-3;
  if (places.empty() || !grows || std::abs(places.front()) > near ||
      std::abs(places.back() - axis.cells) > near) {
    return std::nullopt;
  }
  // Each lies between two of the grid, and then between closer ones.
  const std::size_t count = static_cast<std::size_t>(axis.cells * Axis::parts) + 1;
  const auto wanted = [&](std::size_t k) { return static_cast<double>(k) / Axis::parts; };
  std::vector<float> low, high;
  for (std::size_t k = 0; k < count; ++k) {
    const auto above = std::ranges::upper_bound(places, wanted(k)) - places.begin();
    const auto first = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - 1, 0, grid - 1));
    low.push_back(numbers[first]);
    high.push_back(numbers[first + 1]);
  }
  constexpr int halvings = 14;  // Of a step of the grid, to what floats tell apart.
  std::vector<float> middle(count);
  for (int round = 0; round < halvings; ++round) {
    for (std::size_t k = 0; k < count; ++k) middle[k] = 0.5f * (low[k] + high[k]);
    const std::vector<double> here = places_of(middle);
    if (here.empty()) return std::nullopt;
    for (std::size_t k = 0; k < count; ++k) (here[k] <= wanted(k) ? low : high)[k] = middle[k];
  }
  return low;
}

Ref record_place(Recorder& recorder, const Axis& axis, Ref x) {
  const double width = axis.high - axis.low;
  const auto scaled = [&](double to) {
    return recorder.emit(Op::fma,
                         std::array{x, literal(to / width), literal(-axis.low * to / width)});
  };
  if (axis.along == Axis::Along::number) return scaled(axis.cells);
  const Ref share = recorder.emit(Op::max, std::array{scaled(1), literal(0)});
  const Ref root = recorder.emit(Op::sqrt, std::array{share});
  return recorder.emit(Op::mul, std::array{root, literal(axis.cells)});
}

}  // namespace nacre
