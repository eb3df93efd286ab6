#pragma once

#include <nacre/nacre.hpp>
#include <vector>

namespace graph_image {

/// The arrays that points of the plane are in, for nacre::Batch.
enum PlaneArray : std::uint32_t { array_u, array_v, array_change, array_result, array_count };

/// Says where the numbers of the plane that `nacre bake` shades are: (u, v, 0) is the position in
/// every space, N = (0, 0, 1), T = (1, 0, 0), B = (0, 1, 0), the viewer is straight above, every
/// set of texture coordinates is (u, v); what else `shader` reads is 0. `array_change` has the
/// footprint: du of one point to the right, dv of one point down.
void bind_plane(const nacre::Shader& shader, nacre::Binder& binder);

/// Points of a grid of `width` x `height` on the unit square whose corner is (corner_u, corner_v).
/// Row 0 is the top one.
class PlaneGrid {
 public:
  PlaneGrid(int width, int height, int corner_u, int corner_v);

  float u(int column) const {
    return static_cast<float>(corner_u_) + (static_cast<float>(column) + 0.5f) * change_[0];
  }
  float v(int row) const {
    return static_cast<float>(corner_v_) + (1.0f + (static_cast<float>(row) + 0.5f) * change_[1]);
  }
  /// du and dv, for `array_change`.
  const float* change() const { return change_; }

 private:
  int corner_u_, corner_v_;
  float change_[2];
};

}  // namespace graph_image
