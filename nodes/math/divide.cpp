#include "nodes/math/matrix.h"
#include "nodes/math/safe.h"
#include "runtime/node/componentwise.h"

namespace nacre {

/// in1 / in2 componentwise, or in1 times the inverse of in2 for matrices.
/// MaterialX 1.39 Standard Nodes, "divide". A quotient that is not finite is 0
/// and a singular in2 counts as the identity, as in Open Shading Language. That
/// holds for x / 0, for infinities and for NaN. The matrix product is IEEE's, see
/// safe.h.
void record_divide(NodeCall& call) {
  if (is_matrix(call.out_type())) {
    set_matrix(call, matrix_input(call, "in1") * inverse(matrix_input(call, "in2")));
  } else {
    componentwise(call, ports("in1", "in2"), safe_divide);
  }
}

}  // namespace nacre
