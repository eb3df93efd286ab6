#include "nodes/math/safe.h"
#include "runtime/node/componentwise.h"

namespace nacre {

/// Arc cosine in radians; of the nearer end for what lies outside [-1, 1].
/// MaterialX 1.39 Standard Nodes, "acos". NaN passes.
void record_acos(NodeCall& call) {
  componentwise(call, ports("in"), [](Float x) { return acos(unit_range(x)); });
}

}  // namespace nacre
