#include "nodes/math/safe.h"
#include "runtime/node/componentwise.h"

namespace nacre {

/// Arc sine in radians; of the nearer end for what lies outside [-1, 1].
/// MaterialX 1.39 Standard Nodes, "asin". NaN passes.
void record_asin(NodeCall& call) {
  componentwise(call, ports("in"), [](Float x) { return asin(unit_range(x)); });
}

}  // namespace nacre
