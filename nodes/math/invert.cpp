#include "runtime/node/componentwise.h"

namespace nacre {

/// amount - in, componentwise. MaterialX 1.39 Standard Nodes, "invert". Edges:
/// IEEE, see safe.h.
void record_invert(NodeCall& call) {
  componentwise(call, ports("in", "amount"), [](Float x, Float amount) { return amount - x; });
}

}  // namespace nacre
