#include "nodes/noise/worley.h"

namespace nacre {

/// Distances to the nearest feature points, one a component, or random numbers of
/// the nearest one's cell. MaterialX 1.39 Standard Nodes, "worleynoise3d". Edges as
/// in nodes/noise/worley.h.
void record_worleynoise3d(NodeCall& call) { record_worley(call, call.vector3("position")); }

}  // namespace nacre
