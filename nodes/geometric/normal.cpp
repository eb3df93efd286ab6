#include "runtime/node/geometry.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// The shading normal, unit, in the space named: world, object, or model, which is
/// object space here. MaterialX 1.39 Standard Nodes, "normal". Passes as the host
/// supplies it: unit or not, zero or NaN.
void record_normal(NodeCall& call) {
  call.set(normal(call.recorder(), parse_space(call.text("space"))));
}

}  // namespace nacre
