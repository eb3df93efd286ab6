#include "nodes/noise/worley.h"

namespace nacre {

/// Distances to the nearest feature points, one a component, or random numbers of
/// the nearest one's cell. MaterialX 1.39 Standard Nodes, "worleynoise2d". Edges as
/// in nodes/noise/worley.h.
void record_worleynoise2d(NodeCall& call) { record_worley(call, call.vector2("texcoord")); }

}  // namespace nacre
