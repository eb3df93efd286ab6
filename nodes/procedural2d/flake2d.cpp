#include "nodes/noise/flake.h"

namespace nacre {

/// flake3d on the plane through (u, v, 0). MaterialX 1.39 Standard Nodes,
/// "flake2d". Edges as there.
void record_flake2d(NodeCall& call) {
  const Float2 uv = call.vector2("texcoord");
  record_flake(call, Float3(uv.x, uv.y, 0.0f));
}

}  // namespace nacre
