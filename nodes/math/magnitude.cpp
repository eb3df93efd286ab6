#include "nodes/math/length.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// |in|. MaterialX 1.39 Standard Nodes, "magnitude". The squares neither overflow
/// nor vanish for any finite vector.
void record_magnitude(NodeCall& call) {
  const ScaledVector v = scale_vector(call.in("in"));
  call.set(sqrt(v.squared) * v.unscale);
}

}  // namespace nacre
