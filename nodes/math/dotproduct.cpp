#include "runtime/node/node_call.h"

namespace nacre {

/// Sum of the products of the components. MaterialX 1.39 Standard Nodes,
/// "dotproduct". Edges: IEEE, see safe.h.
void record_dotproduct(NodeCall& call) {
  const Recorded& a = call.in("in1");
  const Recorded& b = call.in("in2");
  Float sum = a.number(0) * b.number(0);
  for (std::size_t i = 1; i < a.parts.size(); ++i) sum = fma(a.number(i), b.number(i), sum);
  call.set(sum);
}

}  // namespace nacre
