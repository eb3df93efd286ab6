#include "nodes/noise/flake.h"

namespace nacre {

/// Metal flakes in a volume: a number and a random value for each flake, its
/// priority (0: no flake here) and a tilted normal. MaterialX 1.39 Standard Nodes,
/// "flake3d". A size of 0 leaves the one point 0; without a flake the normal is
/// `normal` as given. Coordinates that `size` takes beyond the floats, and NaN, lie
/// in that point too; those beyond the range of int in its last cells. Coverage is
/// limited to [0, 1], NaN counts as 0. A roughness above 1e9 or of NaN counts as
/// 1e9.
void record_flake3d(NodeCall& call) { record_flake(call, call.vector3("position")); }

}  // namespace nacre
