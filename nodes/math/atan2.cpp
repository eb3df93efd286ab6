#include "runtime/node/componentwise.h"

namespace nacre {

/// Angle of the point (inx, iny) in radians, in [-pi, pi]. MaterialX 1.39
/// Standard Nodes, "atan2". 0 for (0, 0), with C99's signs.
void record_atan2(NodeCall& call) {
  componentwise(call, ports("iny", "inx"), [](Float y, Float x) { return atan2(y, x); });
}

}  // namespace nacre
