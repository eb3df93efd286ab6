#include "runtime/node/componentwise.h"

namespace nacre {

/// sin(in), in radians. MaterialX 1.39 Standard Nodes, "sin". NaN for infinities.
void record_sin(NodeCall& call) {
  componentwise(call, ports("in"), [](Float x) { return sin(x); });
}

}  // namespace nacre
