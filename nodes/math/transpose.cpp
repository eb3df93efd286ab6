#include "nodes/math/matrix.h"

namespace nacre {

/// The transposed matrix. MaterialX 1.39 Standard Nodes, "transpose". Entries pass
/// as they are, infinities and NaN too.
void record_transpose(NodeCall& call) { set_matrix(call, transpose(matrix_input(call, "in"))); }

}  // namespace nacre
