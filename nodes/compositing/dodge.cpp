#include "runtime/node/componentwise.h"

namespace nacre {

namespace {

/// bg / (1 - fg), blended over bg by mix. MaterialX 1.39 Standard Nodes,
/// "dodge". |1 - fg| below 1e-8 gives 0, as the specification's generators do. Else
/// edges as in blend.h.
Float dodge(Float fg, Float bg, Float mix) {
  const Float rest = 1.0f - fg;
  return select(abs(rest) < 1e-8f, 0.0f, lerp(bg, bg / rest, mix));
}

}  // namespace

void record_dodge(NodeCall& call) { componentwise(call, ports("fg", "bg", "mix"), dodge); }

}  // namespace nacre
