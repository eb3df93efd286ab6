#include "runtime/node/node_call.h"

namespace nacre {

/// dot of shaders: what comes in goes out. MaterialX 1.39 Standard Nodes, "dot".
void record_closure_dot(NodeCall& call) { call.copy("in"); }

}  // namespace nacre
