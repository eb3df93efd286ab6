#include "nodes/procedural2d/ramp.h"

namespace nacre {

/// valueb below v = center, valuet above it. MaterialX 1.39 Standard Nodes,
/// "splittb". The edge is filtered as that of splitlr. Edge cases too.
void record_splittb(NodeCall& call) {
  const Float t = filtered_step(call.number("center"), call.vector2("texcoord").y);
  record_ramp(call, "valueb", "valuet", t);
}

}  // namespace nacre
