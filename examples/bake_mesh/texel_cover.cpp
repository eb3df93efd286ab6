#include "examples/bake_mesh/texel_cover.h"

#include <algorithm>
#include <limits>
#include <map>
#include <span>
#include <utility>

namespace nacre::host {

void TexelCover::enter(int first, int rows) {
  const auto width = static_cast<std::size_t>(index_.frame().width);
  const std::size_t texels = static_cast<std::size_t>(rows) * width;
  first_ = static_cast<std::size_t>(first) * width;
  entries_.clear();
  is_full_.assign(texels, 0);
  index_.for_each(first, rows, [&](std::uint32_t piece) { add(piece, first, rows); });
  begin_.assign(texels + 1, 0);
  for (const Entry& entry : entries_) ++begin_[entry.texel + 1];
  for (std::size_t i = 0; i < texels; ++i) begin_[i + 1] += begin_[i];
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  pieces_.resize(entries_.size());
  for (const Entry& entry : entries_) pieces_[next[entry.texel]++] = entry.piece;
}

void TexelCover::add(std::uint32_t piece, int first, int rows) {
  const MapFrame& frame = index_.frame();
  const FlatTriangle triangle = index_.layout().triangle(piece, frame);
  const Columns range = rows_of(triangle, first, rows);
  for (int y = range.first; y < range.last; ++y) {
    const Columns columns = columns_of(triangle, y, y + 1, frame.width);
    for (int x = columns.first; x < columns.last; ++x) {
      const auto texel = static_cast<std::uint32_t>((y - first) * frame.width + x);
      if (is_full_[texel] != 0) continue;  // Nothing is left for those that come later.
      entries_.push_back({texel, piece});
      const double left = x, top = y;
      const bool is_full = triangle.contains({left, top}) && triangle.contains({left + 1, top}) &&
                           triangle.contains({left, top + 1}) &&
                           triangle.contains({left + 1, top + 1});
      is_full_[texel] = is_full ? 1 : 0;
    }
  }
}

CoverPoint TexelCover::at(std::size_t texel, FlatPlace place) const {
  const MapFrame& frame = index_.frame();
  const auto width = static_cast<std::size_t>(frame.width);
  const auto pieces = std::span(pieces_).subspan(
      begin_[texel - first_], begin_[texel - first_ + 1] - begin_[texel - first_]);
  for (const std::uint32_t piece : pieces) {
    const FlatTriangle triangle = index_.layout().triangle(piece, frame);
    if (triangle.contains(place)) return {piece, triangle.weights(place), true};
  }
  const FlatPlace middle{static_cast<double>(texel % width) + 0.5,
                         static_cast<double>(texel / width) + 0.5};
  CoverPoint best;
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t piece : pieces) {
    const FlatTriangle triangle = index_.layout().triangle(piece, frame);
    double squared = 0.0;
    const bool is_middle = triangle.contains(middle);
    const FlatWeights weights =
        is_middle ? triangle.weights(middle) : triangle.next_to(middle, squared);
    if (!(squared < least)) continue;
    least = squared;
    best = {piece, weights, false};
  }
  return best;
}

std::vector<Overlap> find_overlaps(const RowIndex& index) {
  constexpr std::uint32_t none = ~0u;
  const MapFrame& frame = index.frame();
  const auto& pieces = index.layout().pieces();
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> counts;
  std::vector<std::uint32_t> owners;  // Of each texel, until it is counted.
  constexpr int band = 64;
  for (int first = 0; first < frame.height; first += band) {
    const int rows = std::min(band, frame.height - first);
    owners.assign(static_cast<std::size_t>(rows) * static_cast<std::size_t>(frame.width), none);
    std::vector<std::uint8_t> is_counted(owners.size());
    index.for_each(first, rows, [&](std::uint32_t piece) {
      const FlatTriangle triangle = index.layout().triangle(piece, frame);
      const Columns range = rows_of(triangle, first, rows);
      for (int y = range.first; y < range.last; ++y) {
        const Columns columns = columns_of(triangle, y + 0.5, y + 0.5, frame.width);
        for (int x = columns.first; x < columns.last; ++x) {
          if (!triangle.contains_strictly({x + 0.5, y + 0.5})) continue;
          const auto texel = static_cast<std::size_t>((y - first) * frame.width + x);
          if (owners[texel] == none) {
            owners[texel] = piece;
          } else if (is_counted[texel] == 0) {
            is_counted[texel] = 1;
            ++counts[{pieces[owners[texel]].mesh, pieces[piece].mesh}];
          }
        }
      }
    });
  }
  std::vector<Overlap> overlaps;
  for (const auto& [meshes, texels] : counts) {
    overlaps.push_back({meshes.first, meshes.second, texels});
  }
  return overlaps;
}

}  // namespace nacre::host
