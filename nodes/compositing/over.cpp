#include "nodes/compositing/blend.h"

namespace nacre {

/// F + B (1 - f), alpha too, blended over bg by mix. Lower-case letters are the alphas.
/// MaterialX 1.39 Standard Nodes, "over". Edges as in blend.h.
void record_over(NodeCall& call) {
  record_alpha_operator(call, [](Color4 fg, Color4 bg) { return add_scaled(fg, 1.0f - fg.w, bg); });
}

}  // namespace nacre
