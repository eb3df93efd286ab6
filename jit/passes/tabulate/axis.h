#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "runtime/value/ref.h"

namespace nacre {

class Recorder;

/// How a range of numbers is parted into cells: a number has a place, from 0 to `cells`.
struct Axis {
  enum class Along {
    number,  ///< Equal cells.
    root,    ///< Of the distance from `low`: denser there.
    given,   ///< By a place that somebody computes from the number, `cost` operations.
  };

  double low = 0, high = 1;
  int cells = 16;
  Along along = Along::number;
  double cost = 0;
  /// Of a place that is given: each cell from this one on is so many.
  int dense_from = 0, dense = 1;
  /// At the borders of cells, and `parts - 1` between each two: in equal steps of the place.
  std::vector<float> numbers{};

  /// Parts of a cell between the numbers that are looked at.
  static constexpr int parts = 12;
};

/// Equal cells of [low, high], or of its root.
Axis axis_of(double low, double high, int cells, Axis::Along along);

/// Places of numbers, in double precision; empty where they cannot be had.
using PlacesOf = std::function<std::vector<double>(std::span<const float> numbers)>;

/// An axis of given cells whose last ones are three each, `most` in all: axes of views that are
/// denser towards grazing have wide ones where facets are seen from above.
Axis with_dense_end(Axis axis, int most);

/// Axis::numbers of an axis whose places are given. Nothing where they do not grow with the number,
/// from 0 to `cells`.
std::optional<std::vector<float>> numbers_of_places(const Axis& axis, const PlacesOf& places_of);

/// The place of x, which lies in [low, high], on an axis of axis_of().
Ref record_place(Recorder& recorder, const Axis& axis, Ref x);
/// That of a number whose place is given, among equal cells.
Ref record_dense_place(Recorder& recorder, const Axis& axis, Ref place);

}  // namespace nacre
