#include "runtime/node/node_call.h"

namespace nacre {

/// Either of two truth values. MaterialX 1.39 Standard Nodes, "or". Truth values
/// have no edges.
void record_or(NodeCall& call) { call.set(call.boolean("in1") | call.boolean("in2")); }

}  // namespace nacre
