#include "nodes/math/matrix.h"

namespace nacre {

/// The inverse matrix. MaterialX 1.39 Standard Nodes, "invertmatrix". A matrix
/// whose determinant is zero or not finite gives the identity, as in Open
/// Shading Language.
void record_invertmatrix(NodeCall& call) { set_matrix(call, inverse(matrix_input(call, "in"))); }

}  // namespace nacre
