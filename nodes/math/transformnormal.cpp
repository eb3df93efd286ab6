#include "nodes/math/space.h"

namespace nacre {

/// A normal from one space to another, by the transposed matrix of the way back,
/// and made unit again. MaterialX 1.39 Standard Nodes, "transformnormal". Where
/// nothing changes, `in` passes as it is. One whose square leaves the floats
/// (shorter than 1e-19, longer than 1.8e19) becomes zero; NaN and infinities give
/// NaN.
void record_transformnormal(NodeCall& call) {
  const Float3 n = call.vector3("in");
  const SpaceChange change = space_change(call);
  if (change == SpaceChange::none) return call.set(n);
  const Matrix back = space_matrix(call.recorder(), change, true);
  call.set(normalize(through(transpose(back), n, 0.0f)));
}

}  // namespace nacre
