#include "nodes/math/matrix.h"
#include "runtime/node/componentwise.h"

namespace nacre {

/// in1 in2: componentwise, or the matrix product. MaterialX 1.39 Standard Nodes,
/// "multiply". Row vectors on the left, so in1 is applied first. Edges: IEEE, see
/// safe.h.
void record_multiply(NodeCall& call) {
  if (is_matrix(call.out_type())) {
    set_matrix(call, matrix_input(call, "in1") * matrix_input(call, "in2"));
  } else {
    componentwise(call, ports("in1", "in2"), [](Float a, Float b) { return a * b; });
  }
}

}  // namespace nacre
