#include "runtime/node/geometry.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// The frame number, 1 unless the host says otherwise. MaterialX 1.39 Standard
/// Nodes, "frame". Passes as the host sets it, NaN too.
void record_frame(NodeCall& call) { call.set(uniform(call.recorder(), "frame", 1.0f)); }

}  // namespace nacre
