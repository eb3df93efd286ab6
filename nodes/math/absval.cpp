#include "runtime/node/componentwise.h"

namespace nacre {

/// |in|. MaterialX 1.39 Standard Nodes, "absval". 0 for -0, infinite for
/// infinities; NaN passes.
void record_absval(NodeCall& call) {
  componentwise(call, ports("in"), [](Float x) { return abs(x); });
}

}  // namespace nacre
