#include "runtime/node/node_call.h"

namespace nacre {

/// Both of two truth values. MaterialX 1.39 Standard Nodes, "and". Truth values
/// have no edges.
void record_and(NodeCall& call) { call.set(call.boolean("in1") & call.boolean("in2")); }

}  // namespace nacre
