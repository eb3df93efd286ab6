#include "runtime/node/node_call.h"

namespace nacre {

/// The opposite truth value. MaterialX 1.39 Standard Nodes, "not". Truth values
/// have no edges.
void record_not(NodeCall& call) { call.set(!call.boolean("in")); }

}  // namespace nacre
