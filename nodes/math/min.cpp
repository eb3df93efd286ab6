#include "runtime/node/componentwise.h"

namespace nacre {

/// The lesser, componentwise; in2 where either is NaN. MaterialX 1.39 Standard
/// Nodes, "min".
void record_min(NodeCall& call) {
  componentwise(call, ports("in1", "in2"), [](Float a, Float b) { return min(a, b); });
}

}  // namespace nacre
