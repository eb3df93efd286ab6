#include "examples/bake_mesh/row_index.h"

#include <algorithm>
#include <cmath>

namespace nacre::host {

namespace {

int whole(double x, int least, int most) {
  return static_cast<int>(std::clamp(x, static_cast<double>(least), static_cast<double>(most)));
}

/// What a triangle covers of a map, at most, in maps.
double share_of(const FlatTriangle& triangle, const MapFrame& frame) {
  const double width =
      std::min(triangle.high_x(), double(frame.width)) - std::max(triangle.low_x(), 0.0);
  const double height =
      std::min(triangle.high_y(), double(frame.height)) - std::max(triangle.low_y(), 0.0);
  if (!(width > 0.0 && height > 0.0)) return 0.0;
  return std::min(triangle.area(), width * height) / static_cast<double>(frame.texels());
}

}  // namespace

Columns columns_of(const FlatTriangle& triangle, double low_y, double high_y, int width) {
  double left = 0.0, right = 0.0;
  if (!triangle.span(low_y, high_y, left, right) || right < 0.0 || left > width) return {};
  const int first = whole(std::floor(left), 0, width);
  return {first, std::max(whole(std::ceil(right), 0, width), std::min(first + 1, width))};
}

Columns rows_of(const FlatTriangle& triangle, int first, int rows) {
  return {whole(std::floor(triangle.low_y()), first, first + rows),
          whole(std::ceil(triangle.high_y()), first, first + rows)};
}

RowIndex::RowIndex(const UvLayout& layout, const MapFrame& frame) : layout_(layout), frame_(frame) {
  const auto bands = static_cast<std::size_t>((frame.height + rows_of_a_band - 1) / rows_of_a_band);
  begin_.assign(bands + 1, 0);
  const auto count = static_cast<std::uint32_t>(layout.pieces().size());
  const auto for_each_band = [&](std::uint32_t piece, const auto& take) {
    const FlatTriangle triangle = layout.triangle(piece, frame);
    if (triangle.high_x() <= 0.0 || triangle.low_x() >= frame.width) return;
    const Columns rows = rows_of(triangle, 0, frame.height);
    if (rows.first >= rows.last) return;
    for (int band = rows.first / rows_of_a_band; band <= (rows.last - 1) / rows_of_a_band; ++band) {
      take(static_cast<std::size_t>(band));
    }
  };
  for (std::uint32_t i = 0; i < count; ++i) {
    for_each_band(i, [&](std::size_t band) { ++begin_[band + 1]; });
    depth_ += share_of(layout.triangle(i, frame), frame);
  }
  for (std::size_t band = 0; band < bands; ++band) begin_[band + 1] += begin_[band];
  pieces_.resize(begin_.back());
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  for (std::uint32_t i = 0; i < count; ++i) {
    for_each_band(i, [&](std::size_t band) { pieces_[next[band]++] = i; });
  }
}

void RowIndex::for_each(int first, int rows, const std::function<void(std::uint32_t)>& take) const {
  const int last_band = (first + rows - 1) / rows_of_a_band;
  // Pieces of several bands are met once, and in order.
  std::vector<std::uint32_t> all;
  for (int band = first / rows_of_a_band; band <= last_band; ++band) {
    const auto b = static_cast<std::size_t>(band);
    all.insert(all.end(), pieces_.begin() + static_cast<std::ptrdiff_t>(begin_[b]),
               pieces_.begin() + static_cast<std::ptrdiff_t>(begin_[b + 1]));
  }
  std::ranges::sort(all);
  const auto repeated = std::ranges::unique(all);
  all.erase(repeated.begin(), repeated.end());
  std::ranges::for_each(all, take);
}

}  // namespace nacre::host
