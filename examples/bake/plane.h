#pragma once

#include <string_view>
#include <vector>

#include "examples/bake/bake.h"
#include "examples/bake/surface.h"

namespace nacre::host {

/// The plane that `bake` shades where it is given no other surface. A point (x, y) of a width x
/// height image has uv = corner + area * (x/width, 1-y/height), P = (u, v, 0) in every space, N =
/// (0,0,1), T = (1,0,0), B = (0,1,0), and a viewer straight above.
class Plane : public SurfacePoints {
 public:
  Plane(int width, int height, UvArea area = {}) : width_(width), height_(height), area_(area) {}

  void fill(std::string_view channel, const TexelPoints& points,
            std::vector<float>& values) const override;
  bool is_constant(std::string_view channel) const override;

 private:
  int width_, height_;
  UvArea area_;
};

}  // namespace nacre::host
