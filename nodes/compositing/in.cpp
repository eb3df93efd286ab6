#include "nodes/compositing/blend.h"

namespace nacre {

/// F b, alpha too, blended over bg by mix. Lower-case letters are the alphas.
/// MaterialX 1.39 Standard Nodes, "in". Edges as in blend.h.
void record_in(NodeCall& call) {
  record_alpha_operator(call, [](Color4 fg, Color4 bg) { return scaled(bg.w, fg); });
}

}  // namespace nacre
