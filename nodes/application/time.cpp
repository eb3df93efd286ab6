#include "runtime/node/geometry.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// The time in seconds, 0 unless the host says otherwise. MaterialX 1.39 Standard
/// Nodes, "time"; its deprecated input fps says nothing. Passes as the host sets
/// it, NaN too.
void record_time(NodeCall& call) { call.set(uniform(call.recorder(), "time", 0.0f)); }

}  // namespace nacre
