#include "nodes/compositing/blend.h"

namespace nacre {

/// B f, alpha too, blended over bg by mix. Lower-case letters are the alphas.
/// MaterialX 1.39 Standard Nodes, "mask". Edges as in blend.h.
void record_mask(NodeCall& call) {
  record_alpha_operator(call, [](Color4 fg, Color4 bg) { return scaled(fg.w, bg); });
}

}  // namespace nacre
