#include "nodes/math/space.h"

namespace nacre {

/// A vector from one space to another. MaterialX 1.39 Standard Nodes,
/// "transformvector"; spaces as runtime/node/geometry.h has them. Where nothing
/// changes `in` passes as it is; else edges are IEEE's, see safe.h.
void record_transformvector(NodeCall& call) {
  const Float3 v = call.vector3("in");
  const SpaceChange change = space_change(call);
  if (change == SpaceChange::none) return call.set(v);
  call.set(through(space_matrix(call.recorder(), change), v, 0.0f));
}

}  // namespace nacre
