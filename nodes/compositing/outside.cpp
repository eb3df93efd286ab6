#include "runtime/node/componentwise.h"

namespace nacre {

/// in (1 - mask). MaterialX 1.39 Standard Nodes, "outside". Edges as in blend.h; a
/// mask of 1 makes NaN of an infinity.
void record_outside(NodeCall& call) {
  componentwise(call, ports("in", "mask"), [](Float x, Float mask) { return x * (1.0f - mask); });
}

}  // namespace nacre
