#include "runtime/node/node_call.h"

namespace nacre {

/// in, whatever its type. MaterialX 1.39 Standard Nodes, "dot". Infinities and NaN
/// pass.
void record_dot(NodeCall& call) { call.copy("in"); }

}  // namespace nacre
