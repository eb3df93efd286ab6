#pragma once

#include <string_view>
#include <vector>

#include "examples/bake/surface.h"

namespace nacre::host {

/// The plane that `bake` shades where it is given no other surface. A point (x, y) of a width x
/// height image has uv = corner + (x/width, 1-y/height), P = (u, v, 0) in every space, N = (0,0,1),
/// T = (1,0,0), B = (0,1,0), and a viewer straight above.
class Plane : public SurfacePoints {
 public:
  Plane(int width, int height, int corner_u = 0, int corner_v = 0)
      : width_(width), height_(height), corner_u_(corner_u), corner_v_(corner_v) {}

  void fill(std::string_view channel, const TexelPoints& points,
            std::vector<float>& values) const override;
  bool is_constant(std::string_view channel) const override;

 private:
  int width_, height_;
  int corner_u_, corner_v_;
};

}  // namespace nacre::host
