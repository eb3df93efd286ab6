#include "nodes/math/rounding.h"

namespace nacre {

/// The least integer not below in. MaterialX 1.39 Standard Nodes, "ceil". The
/// integer overload clamps to the range of int and gives 0 for NaN.
void record_ceil(NodeCall& call) {
  record_rounding(call, [](Float x) { return ceil(x); });
}

}  // namespace nacre
