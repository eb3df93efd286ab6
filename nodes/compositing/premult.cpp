#include "runtime/node/node_call.h"

namespace nacre {

/// Colour times alpha. MaterialX 1.39 Standard Nodes, "premult". Edges as in
/// blend.h; an alpha of 0 makes NaN of an infinity.
void record_premult(NodeCall& call) {
  const Color4 c = call.vector4("in");
  call.set(Color4{c.x * c.w, c.y * c.w, c.z * c.w, c.w});
}

}  // namespace nacre
