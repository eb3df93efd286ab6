#include <utility>

#include "nodes/math/length.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// in / |in|. MaterialX 1.39 Standard Nodes, "normalize". Zero for the zero
/// vector, as in Open Shading Language; of unit length for every other finite
/// vector, however long or short. Zero or NaN components where one is infinite.
void record_normalize(NodeCall& call) {
  const ScaledVector v = scale_vector(call.in("in"));
  const Float inverse = select(v.squared > 0.0f, 1.0f / sqrt(v.squared), 0.0f);
  std::vector<Ref> parts;
  for (const Float& component : v.components) parts.push_back((component * inverse).ref());
  call.set(std::move(parts));
}

}  // namespace nacre
