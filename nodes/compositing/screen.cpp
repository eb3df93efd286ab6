#include "nodes/compositing/blend.h"

namespace nacre {

/// 1 - (1 - fg)(1 - bg), blended over bg by mix, which is bg + mix fg (1 - bg).
/// MaterialX 1.39 Standard Nodes, "screen". Edges as in blend.h; NaN for an
/// infinite bg unless mix fg is negative.
void record_screen(NodeCall& call) {
  componentwise(call, ports("fg", "bg", "mix"),
                [](Float fg, Float bg, Float mix) { return fma(mix * fg, 1.0f - bg, bg); });
}

}  // namespace nacre
