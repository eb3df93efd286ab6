#include "nodes/math/safe.h"
#include "runtime/node/componentwise.h"

namespace nacre {

/// Natural logarithm. MaterialX 1.39 Standard Nodes, "ln". Zero and below give
/// that of the smallest normal float, -87.34, as in Open Shading Language.
void record_ln(NodeCall& call) {
  componentwise(call, ports("in"), [](Float x) { return safe_log(x); });
}

}  // namespace nacre
