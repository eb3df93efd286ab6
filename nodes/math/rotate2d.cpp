#include "nodes/math/angle.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// in turned clockwise about the origin by `amount` degrees, so that an image
/// whose coordinates it turns goes counter-clockwise. MaterialX 1.39 Standard
/// Nodes, "rotate2d". NaN for an infinite amount.
void record_rotate2d(NodeCall& call) {
  const Float2 v = call.vector2("in");
  const SinCos angle = sin_cos_degrees(call.number("amount"));
  call.set(Float2{fma(angle.cos, v.x, angle.sin * v.y), fma(angle.cos, v.y, -(angle.sin * v.x))});
}

}  // namespace nacre
