#include "runtime/node/componentwise.h"

namespace nacre {

/// in1 - in2, componentwise; integers wrap. MaterialX 1.39 Standard Nodes,
/// "subtract". Edges: IEEE, see safe.h.
void record_subtract(NodeCall& call) {
  componentwise_number(call, ports("in1", "in2"), [](auto a, auto b) { return a - b; });
}

}  // namespace nacre
