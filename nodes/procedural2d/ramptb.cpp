#include "nodes/procedural2d/ramp.h"

namespace nacre {

/// From valueb at v = 0 to valuet at v = 1, constant beyond. MaterialX 1.39 Standard
/// Nodes, "ramptb". NaN coordinates count as 0; an infinite value on either side
/// gives NaN.
void record_ramptb(NodeCall& call) {
  record_ramp(call, "valueb", "valuet", saturate(call.vector2("texcoord").y));
}

}  // namespace nacre
