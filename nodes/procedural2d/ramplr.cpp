#include "nodes/procedural2d/ramp.h"

namespace nacre {

/// From valuel at u = 0 to valuer at u = 1, constant beyond. MaterialX 1.39 Standard
/// Nodes, "ramplr". NaN coordinates count as 0; an infinite value on either side
/// gives NaN.
void record_ramplr(NodeCall& call) {
  record_ramp(call, "valuel", "valuer", saturate(call.vector2("texcoord").x));
}

}  // namespace nacre
