#pragma once

#include <string_view>
#include <vector>

#include "runtime/program/program.h"

namespace nacre::host {

/// The plane that `bake` shades. Texel (i, j) of a width x height image, j
/// counted from the top row, has uv = corner + ((i+1/2)/width, 1-(j+1/2)/height),
/// P = (u, v, 0) in every space, N = (0,0,1), T = (1,0,0), B = (0,1,0), a viewer
/// straight above, and a footprint of one texel.
class Plane {
 public:
  Plane(int width, int height, int corner_u = 0, int corner_v = 0)
      : width_(width), height_(height), corner_u_(corner_u), corner_v_(corner_v) {}

  int width() const { return width_; }
  int height() const { return height_; }

  /// Values of an input channel (runtime/node/geometry.h) for the texels of rows
  /// [first, first + rows), row by row. Unknown channels are 0.
  void fill(std::string_view channel, int first, int rows, std::vector<float>& values) const;

 private:
  int width_, height_;
  int corner_u_, corner_v_;
};

}  // namespace nacre::host
