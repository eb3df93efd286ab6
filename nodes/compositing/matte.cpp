#include "nodes/compositing/blend.h"

namespace nacre {

/// F f + B (1 - f), alpha f + b (1 - f), blended over bg by mix. Lower-case letters
/// are the alphas. MaterialX 1.39 Standard Nodes, "matte". Edges as in blend.h.
void record_matte(NodeCall& call) {
  record_alpha_operator(call, [](Color4 fg, Color4 bg) {
    const Color4 weighted{fg.x * fg.w, fg.y * fg.w, fg.z * fg.w, fg.w};
    return add_scaled(weighted, 1.0f - fg.w, bg);
  });
}

}  // namespace nacre
