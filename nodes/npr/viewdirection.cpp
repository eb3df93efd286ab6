#include "nodes/math/space.h"

namespace nacre {

/// Unit direction from the viewer to the point, in the space named. MaterialX 1.39
/// NPR Library, "viewdirection"; the library's facingratio negates it, so it
/// points at the surface. World space passes as the host supplies it; in the others
/// zero where the change of space leaves nothing.
void record_viewdirection(NodeCall& call) {
  const Float3 world = -view_direction(call.recorder());
  if (parse_space(call.text("space")) == Space::world) return call.set(world);
  const Matrix m = space_matrix(call.recorder(), SpaceChange::world_to_object);
  call.set(normalize(through(m, world, 0.0f)));
}

}  // namespace nacre
