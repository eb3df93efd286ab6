#include "jit/passes/tabulate/axis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "runtime/program/recorder.h"

namespace nacre {

namespace {

/// Numbers between which a place is, and how far theirs are below and above it.
struct Bracket {
  double low, high, below, above;

  float guess() const {
    const double width = above - below;
    const double share = width > 0 ? std::clamp(-below / width, 0.0, 1.0) : 0.0;
    return static_cast<float>(low + share * (high - low));
  }
  void narrow(double number, double off) {
    if (off <= 0) {
      low = number;
      below = off;
      above *= 0.5;
    } else {
      high = number;
      above = off;
      below *= 0.5;
    }
  }
};

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
  constexpr int grid = 256;
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
  // Each lies between two of the grid, and then between closer ones: regula falsi, where an end
  // that stays counts half the next time (Illinois; Dowell and Jarratt 1971).
  std::vector<Bracket> brackets;
  const int last = axis.cells * Axis::parts;
  for (int k = 0; k <= last; ++k) {
    const double wanted = static_cast<double>(k) / Axis::parts;
    const auto above = std::ranges::upper_bound(places, wanted) - places.begin();
    const auto first = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - 1, 0, grid - 1));
    brackets.push_back(
        {numbers[first], numbers[first + 1], places[first] - wanted, places[first + 1] - wanted});
  }
  constexpr int rounds = 6;  // To what floats tell apart, of what is smooth.
  std::vector<float> found(brackets.size());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t k = 0; k < found.size(); ++k) found[k] = brackets[k].guess();
    const std::vector<double> here = places_of(found);
    if (here.empty()) return std::nullopt;
    for (std::size_t k = 0; k < found.size(); ++k) {
      brackets[k].narrow(found[k], here[k] - static_cast<double>(k) / Axis::parts);
    }
  }
  for (std::size_t k = 0; k < found.size(); ++k) found[k] = brackets[k].guess();
  return found;
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
