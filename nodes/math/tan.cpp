#include "runtime/node/componentwise.h"

namespace nacre {

/// tan(in), in radians. MaterialX 1.39 Standard Nodes, "tan". NaN for infinities.
void record_tan(NodeCall& call) {
  componentwise(call, ports("in"), [](Float x) { return tan(x); });
}

}  // namespace nacre
