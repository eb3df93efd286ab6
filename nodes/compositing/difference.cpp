#include "nodes/compositing/blend.h"

namespace nacre {

/// |bg - fg|, blended over bg by mix. MaterialX 1.39 Standard Nodes, "difference".
/// Edges as in blend.h.
void record_difference(NodeCall& call) {
  componentwise(call, ports("fg", "bg", "mix"),
                [](Float fg, Float bg, Float mix) { return blend(bg, abs(bg - fg), mix); });
}

}  // namespace nacre
