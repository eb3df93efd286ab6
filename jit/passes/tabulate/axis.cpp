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
  int moved = 0;  ///< The end that was moved last: -1 the low one, 1 the high one.

  float guess() const {
    const double width = above - below;
    const double share = width > 0 ? std::clamp(-below / width, 0.0, 1.0) : 0.0;
    return static_cast<float>(low + share * (high - low));
  }
  void narrow(double number, double off) {
    const int moves = off <= 0 ? -1 : 1;
    const double stays = moves == moved ? 0.5 : 1.0;
    if (moves < 0) {
      low = number;
      below = off;
      above *= stays;
    } else {
      high = number;
      above = off;
      below *= stays;
    }
    moved = moves;
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

Axis with_dense_end(Axis axis, int most) {
  axis.dense = 3;
  const int more = axis.dense - 1;
  const int parted = std::min(axis.cells, (most - axis.cells) / more);
  axis.dense_from = axis.cells - parted;
  axis.cells += parted * more;
  axis.cost += 2;
  return axis;
}

std::optional<std::vector<float>> numbers_of_places(const Axis& axis, const PlacesOf& places_of) {
  constexpr int grid = 256;
  std::vector<float> numbers;
  for (int i = 0; i <= grid; ++i) {
    numbers.push_back(static_cast<float>(axis.low + (axis.high - axis.low) * i / grid));
  }
  const auto dense = [&](std::vector<double> places) {
    for (double& place : places) {
      place += (axis.dense - 1) * std::max(place - axis.dense_from, 0.0);
    }
    return places;
  };
  const std::vector<double> places = dense(places_of(numbers));
  const bool grows = std::ranges::adjacent_find(places, std::greater_equal{}) == places.end();
  constexpr double near = 1e-3;
  if (places.empty() || !grows || std::abs(places.front()) > near ||
      std::abs(places.back() - axis.cells) > near) {
    return std::nullopt;
  }
  // Each lies between two of the grid, and then between closer ones: regula falsi, where an end
  // that stays a second time counts half (Illinois; Dowell and Jarratt 1971).
  std::vector<Bracket> brackets;
  const int last = axis.cells * Axis::parts;
  for (int k = 0; k <= last; ++k) {
    const double wanted = static_cast<double>(k) / Axis::parts;
    const auto above = std::ranges::upper_bound(places, wanted) - places.begin();
    const auto first = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - 1, 0, grid - 1));
    brackets.push_back(
        {numbers[first], numbers[first + 1], places[first] - wanted, places[first + 1] - wanted});
  }
  constexpr int rounds = 10;  // To what floats tell apart, of what is smooth.
  std::vector<float> found(brackets.size());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t k = 0; k < found.size(); ++k) found[k] = brackets[k].guess();
    const std::vector<double> here = dense(places_of(found));
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

Ref record_dense_place(Recorder& recorder, const Axis& axis, Ref place) {
  if (axis.dense == 1) return place;
  const Ref beyond = recorder.emit(Op::sub, std::array{place, literal(axis.dense_from)});
  const Ref more = recorder.emit(Op::max, std::array{beyond, literal(0)});
  return recorder.emit(Op::fma, std::array{more, literal(axis.dense - 1), place});
}

}  // namespace nacre
