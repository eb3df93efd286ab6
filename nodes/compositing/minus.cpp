#include "nodes/compositing/blend.h"

namespace nacre {

/// bg - fg, blended over bg by mix, which is bg - mix fg. MaterialX 1.39 Standard
/// Nodes, "minus". Edges as in blend.h; NaN for an infinite fg and a mix of 0.
void record_minus(NodeCall& call) {
  componentwise(call, ports("fg", "bg", "mix"),
                [](Float fg, Float bg, Float mix) { return fma(-mix, fg, bg); });
}

}  // namespace nacre
