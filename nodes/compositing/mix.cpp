#include "nodes/compositing/blend.h"

namespace nacre {

/// (1 - mix) bg + mix fg, componentwise, for numbers; closures and shaders are
/// mixed in pbs. MaterialX 1.39 Standard Nodes, "mix". A literal 0 or 1 takes one
/// side and nothing of the other, infinities included. Else edges as in blend.h.
void record_mix(NodeCall& call) {
  componentwise(call, ports("fg", "bg", "mix"),
                [](Float fg, Float bg, Float mix) { return blend(bg, fg, mix); });
}

}  // namespace nacre
