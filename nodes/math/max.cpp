#include "runtime/node/componentwise.h"

namespace nacre {

/// The greater, componentwise; in2 where either is NaN. MaterialX 1.39 Standard
/// Nodes, "max".
void record_max(NodeCall& call) {
  componentwise(call, ports("in1", "in2"), [](Float a, Float b) { return max(a, b); });
}

}  // namespace nacre
