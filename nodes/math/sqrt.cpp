#include "runtime/node/componentwise.h"

namespace nacre {

/// Square root; 0 below zero and for NaN. MaterialX 1.39 Standard Nodes, "sqrt".
void record_sqrt(NodeCall& call) {
  componentwise(call, ports("in"), [](Float x) { return safe_sqrt(x); });
}

}  // namespace nacre
