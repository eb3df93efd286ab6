#include "runtime/node/node_call.h"

namespace nacre {

/// Colour divided by alpha. MaterialX 1.39 Standard Nodes, "unpremult". What has
/// no alpha passes unchanged, as the specification says (its generators divide).
/// Other quotients are IEEE's: a tiny alpha may give infinity, an infinite one
/// gives 0, NaN passes.
void record_unpremult(NodeCall& call) {
  const Color4 c = call.vector4("in");
  const Float divisor = select(c.w == 0.0f, 1.0f, c.w);
  call.set(Color4{c.x / divisor, c.y / divisor, c.z / divisor, c.w});
}

}  // namespace nacre
