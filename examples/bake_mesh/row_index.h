#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "examples/bake_mesh/uv_layout.h"

namespace nacre::host {

/// Which pieces of a layout are in which rows of a map; for all threads.
class RowIndex {
 public:
  RowIndex(const UvLayout& layout, const MapFrame& frame);

  const UvLayout& layout() const { return layout_; }
  const MapFrame& frame() const { return frame_; }
  /// How often the pieces would cover the map, if they were spread over it evenly; not less.
  double depth() const { return depth_; }

  /// Calls `take` with each piece that may be in rows [first, first + rows), in order.
  void for_each(int first, int rows, const std::function<void(std::uint32_t)>& take) const;

 private:
  static constexpr int rows_of_a_band = 16;

  const UvLayout& layout_;
  MapFrame frame_;
  double depth_ = 0.0;
  std::vector<std::size_t> begin_;     ///< Of each band in `pieces_`, and of all the end.
  std::vector<std::uint32_t> pieces_;  ///< Those of a band in order.
};

/// The columns of a map that a triangle has some part of between two heights: [first, last).
struct Columns {
  int first = 0, last = 0;
};
Columns columns_of(const FlatTriangle& triangle, double low_y, double high_y, int width);

/// The rows of a map that a triangle is in, of [first, first + rows).
Columns rows_of(const FlatTriangle& triangle, int first, int rows);

}  // namespace nacre::host
