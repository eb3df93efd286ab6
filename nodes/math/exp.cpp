#include "runtime/node/componentwise.h"

namespace nacre {

/// e^in. MaterialX 1.39 Standard Nodes, "exp". Infinite above 88.73.
void record_exp(NodeCall& call) {
  componentwise(call, ports("in"), [](Float x) { return exp(x); });
}

}  // namespace nacre
