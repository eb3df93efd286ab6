#include "nodes/math/rounding.h"

namespace nacre {

/// The greatest integer not above in. MaterialX 1.39 Standard Nodes, "floor". The
/// integer overload clamps to the range of int and gives 0 for NaN.
void record_floor(NodeCall& call) {
  record_rounding(call, [](Float x) { return floor(x); });
}

}  // namespace nacre
