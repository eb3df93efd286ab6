#include "nodes/math/angle.h"
#include "nodes/math/length.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// in turned about `axis` by `amount` degrees, by Rodrigues' formula with the
/// cross product in the order of row vectors: v c + (v x a) s + a (a . v)(1 - c).
/// MaterialX 1.39 Standard Nodes, "rotate3d". A zero axis leaves v c, as in Open
/// Shading Language; every other finite axis has a direction, however long or short.
/// NaN for an infinite amount or axis.
void record_rotate3d(NodeCall& call) {
  const Float3 v = call.vector3("in");
  const std::vector<Float> unit = unit_vector(call.in("axis"));
  const Float3 axis(unit[0], unit[1], unit[2]);
  const SinCos angle = sin_cos_degrees(call.number("amount"));
  const Float along = dot(axis, v) * (1.0f - angle.cos);
  call.set(fma(v, Float3(angle.cos), fma(cross(v, axis), Float3(angle.sin), axis * Float3(along))));
}

}  // namespace nacre
