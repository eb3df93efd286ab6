#include "nodes/math/safe.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// t^2 (3 - 2 t) with t = (in - low) / (high - low). MaterialX 1.39 Standard Nodes,
/// "smoothstep". 0 below low, else 1 from high on, in this order as in Open
/// Shading Language: a step at low where the range is empty or turned round. 0
/// for NaN.
void record_smoothstep(NodeCall& call) {
  const Float x = call.number("in");
  const Float low = call.number("low");
  const Float high = call.number("high");
  const Float t = safe_divide(x - low, high - low);
  const Float inside = t * t * fma(-2.0f, t, 3.0f);
  call.set(select(x < low, 0.0f, select(x >= high, 1.0f, inside)));
}

}  // namespace nacre
