#include "runtime/node/componentwise.h"

namespace nacre {

/// cos(in), in radians. MaterialX 1.39 Standard Nodes, "cos". NaN for infinities.
void record_cos(NodeCall& call) {
  componentwise(call, ports("in"), [](Float x) { return cos(x); });
}

}  // namespace nacre
