#pragma once

#include <cstdint>
#include <vector>

#include "examples/render/bounds.h"

namespace nacre::host {

/// How far displacement moves what is where in a mesh: boxes of offsets, by cells of a grid over
/// the mesh. By place alone, so that triangles that meet are told the same.
class OffsetGrid {
 public:
  /// `all`: the box of all places.
  explicit OffsetGrid(const Bounds& all);

  /// Something in that box of places is moved by something in that box of offsets.
  void add(const Bounds& places, const Bounds& offsets);
  /// Of all that was added near there; empty where nothing was.
  const Bounds& at(Vec3 place) const;

 private:
  static constexpr int cells = 16;  ///< Along each axis.

  int cell(float place, float low, float size) const;

  Bounds all_;
  std::vector<Bounds> offsets_;
};

/// How far a point is from what is at a place that is moved by something in that box, at least.
float distance_to_moved(Vec3 point, Vec3 place, const Bounds& offsets);

}  // namespace nacre::host
