#include "runtime/node/geometry.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// The tangent, unit, in the space named: world, object, or model, which is
/// object space here. MaterialX 1.39 Standard Nodes, "tangent". There is one
/// tangent frame, so `index` says nothing. Passes as the host supplies it: unit or
/// not, zero or NaN.
void record_tangent(NodeCall& call) {
  call.set(tangent(call.recorder(), parse_space(call.text("space"))));
}

}  // namespace nacre
