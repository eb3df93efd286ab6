#include "runtime/node/componentwise.h"

namespace nacre {

namespace {

/// 1 - (1 - bg) / fg, blended over bg by mix. MaterialX 1.39 Standard Nodes,
/// "Compositing Nodes: burn". |fg| below 1e-8 gives 0, as the specification's
/// generators do. Else edges as in blend.h.
Float burn(Float fg, Float bg, Float mix) {
  return select(abs(fg) < 1e-8f, 0.0f, lerp(bg, 1 - (1 - bg) / fg, mix));
}

}  // namespace

void record_burn(NodeCall& call) { componentwise(call, ports("fg", "bg", "mix"), burn); }

}  // namespace nacre
