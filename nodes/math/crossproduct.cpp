#include "runtime/node/node_call.h"

namespace nacre {

/// in1 x in2. MaterialX 1.39 Standard Nodes, "crossproduct". Edges: IEEE, see
/// safe.h.
void record_crossproduct(NodeCall& call) {
  call.set(cross(call.vector3("in1"), call.vector3("in2")));
}

}  // namespace nacre
