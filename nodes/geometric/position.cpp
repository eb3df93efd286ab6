#include "runtime/node/geometry.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// The point being shaded, in the space named: world, object, or model, which is
/// object space here. MaterialX 1.39 Standard Nodes, "position". Passes as the host
/// supplies it, however large, NaN too.
void record_position(NodeCall& call) {
  call.set(position(call.recorder(), parse_space(call.text("space"))));
}

}  // namespace nacre
