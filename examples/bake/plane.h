#pragma once

#include <string_view>
#include <vector>

#include "runtime/program/program.h"

namespace nacre::host {

/// Where an image is sampled, in texels from its upper left corner: the middle of the first
/// one is (1/2, 1/2). Footprints are so many texels wide and high.
struct TexelPoints {
  std::vector<float> x, y;
  float footprint = 1.0f;
};

/// The plane that `bake` shades. A point (x, y) of a width x height image has uv =
/// corner + (x/width, 1-y/height), P = (u, v, 0) in every space, N = (0,0,1), T = (1,0,0),
/// B = (0,1,0), and a viewer straight above.
class Plane {
 public:
  Plane(int width, int height, int corner_u = 0, int corner_v = 0)
      : width_(width), height_(height), corner_u_(corner_u), corner_v_(corner_v) {}

  int width() const { return width_; }
  int height() const { return height_; }

  /// Values of an input channel (runtime/node/geometry.h) for points. Unknown channels are 0.
  void fill(std::string_view channel, const TexelPoints& points, std::vector<float>& values) const;
  /// Whether that depends on `points` by their number and footprint only.
  bool is_constant(std::string_view channel) const;

 private:
  int width_, height_;
  int corner_u_, corner_v_;
};

}  // namespace nacre::host
