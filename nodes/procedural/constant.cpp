#include "runtime/node/node_call.h"

namespace nacre {

/// value, whatever its type. MaterialX 1.39 Standard Nodes, "constant". Infinities
/// and NaN pass.
void record_constant(NodeCall& call) { call.copy("value"); }

}  // namespace nacre
