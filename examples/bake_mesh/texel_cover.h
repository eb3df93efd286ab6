#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "examples/bake_mesh/row_index.h"

namespace nacre::host {

/// A point of a piece of a layout.
struct CoverPoint {
  std::uint32_t piece = 0;
  FlatWeights weights;
  bool is_inside = false;  ///< Not: next to the middle of a texel, which is beside the piece.
};

/// Which pieces are in which texels of some rows of a map. Every texel is covered that a piece has
/// any part of. Where several contain a place it is of the first, in the layout's order.
class TexelCover {
 public:
  explicit TexelCover(const RowIndex& index) : index_(index) {}

  /// Rows [first, first + rows), from now on.
  void enter(int first, int rows);
  bool covers(std::size_t texel) const {
    return begin_[texel - first_] < begin_[texel - first_ + 1];
  }

  /// Of a place in a texel that is covered: the piece that contains it, or else the point of the
  /// texel's pieces that is next to the texel's middle.
  CoverPoint at(std::size_t texel, FlatPlace place) const;

 private:
  void add(std::uint32_t piece, int first, int rows);

  const RowIndex& index_;
  std::size_t first_ = 0;           ///< The first texel.
  std::vector<std::size_t> begin_;  ///< Of each texel in `pieces_`, and of all the end.
  std::vector<std::uint32_t> pieces_;

  struct Entry {
    std::uint32_t texel, piece;
  };
  std::vector<Entry> entries_;
  std::vector<std::uint8_t> is_full_;  ///< Of texels all of which one piece has.
};

/// Pieces that lie over each other.
struct Overlap {
  std::uint32_t mesh, other;  ///< Of the scene; may be the same.
  std::size_t texels = 0;     ///< Whose middles more than one piece has, these two first.
};

/// By meshes, those first that come first in the scene.
std::vector<Overlap> find_overlaps(const RowIndex& index);

}  // namespace nacre::host
