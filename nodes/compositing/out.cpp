#include "nodes/compositing/blend.h"

namespace nacre {

/// F (1 - b), alpha too, blended over bg by mix. Lower-case letters are the alphas.
/// MaterialX 1.39 Standard Nodes, "out". Edges as in blend.h.
void record_out(NodeCall& call) {
  record_alpha_operator(call, [](Color4 fg, Color4 bg) { return scaled(1.0f - bg.w, fg); });
}

}  // namespace nacre
