#include "nodes/math/matrix.h"

namespace nacre {

/// The determinant of a matrix. MaterialX 1.39 Standard Nodes, "determinant".
/// Edges: IEEE, see safe.h; of finite entries too, whose products may overflow.
void record_determinant(NodeCall& call) { call.set(determinant(matrix_input(call, "in"))); }

}  // namespace nacre
