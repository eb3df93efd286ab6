#pragma once

#include <algorithm>
#include <cmath>

#include "examples/render/vec.h"

namespace nacre::host {

/// A box along the axes.
struct Bounds {
  Vec3 low = {INFINITY, INFINITY, INFINITY};
  Vec3 high = {-INFINITY, -INFINITY, -INFINITY};

  void add(Vec3 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  bool empty() const { return !(low.x <= high.x); }
};

}  // namespace nacre::host
