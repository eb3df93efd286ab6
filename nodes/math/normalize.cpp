#include <utility>

#include "nodes/math/length.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// in / |in|. MaterialX 1.39 Standard Nodes, "normalize". Zero for the zero
/// vector, as in Open Shading Language; of unit length for every other finite
/// vector, however long or short. Zero or NaN components where one is infinite.
void record_normalize(NodeCall& call) {
  std::vector<Ref> parts;
  for (const Float& component : unit_vector(call.in("in"))) parts.push_back(component.ref());
  call.set(std::move(parts));
}

}  // namespace nacre
