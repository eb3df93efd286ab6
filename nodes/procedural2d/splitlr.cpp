#include "nodes/procedural2d/ramp.h"

namespace nacre {

/// valuel left of u = center, valuer right of it. MaterialX 1.39 Standard Nodes,
/// "splitlr". The edge is filtered over the footprint, by a box that counts the
/// change of `center` too, as in Open Shading Language. An infinite coordinate lies
/// on its side; NaN in it or in `center` gives NaN, and so does an infinite value
/// on either side.
void record_splitlr(NodeCall& call) {
  const Float t = filtered_step(call.number("center"), call.vector2("texcoord").x);
  record_ramp(call, "valuel", "valuer", t);
}

}  // namespace nacre
