#include "runtime/node/componentwise.h"

namespace nacre {

/// in mask. MaterialX 1.39 Standard Nodes, "inside". Edges as in blend.h; a mask of
/// 0 makes NaN of an infinity.
void record_inside(NodeCall& call) {
  componentwise(call, ports("in", "mask"), [](Float x, Float mask) { return x * mask; });
}

}  // namespace nacre
