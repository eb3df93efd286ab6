#include "runtime/node/node_call.h"

namespace nacre {

/// Colour times alpha. MaterialX 1.39 Standard Nodes, "premult".
void record_premult(NodeCall& call) {
  const Color4 c = call.vector4("in");
  call.set(Color4{c.x * c.w, c.y * c.w, c.z * c.w, c.w});
}

}  // namespace nacre
