#include <array>
#include <string_view>

#include "nodes/math/matrix.h"

namespace nacre {

/// A matrix from its rows. MaterialX 1.39 Standard Nodes, "creatematrix". Rows of
/// three components in a matrix44 end in 0, the fourth in 1. Entries pass as they
/// are, infinities and NaN too.
void record_creatematrix(NodeCall& call) {
  constexpr std::array<std::string_view, 4> rows{"in1", "in2", "in3", "in4"};
  Matrix result = identity(call.out_type() == Type::matrix33 ? 3 : 4);
  for (int row = 0; row < result.size; ++row) {
    const Recorded& input = call.in(rows[static_cast<std::size_t>(row)]);
    for (std::size_t column = 0; column < input.parts.size(); ++column) {
      result(row, static_cast<int>(column)) = input.number(column);
    }
  }
  set_matrix(call, result);
}

}  // namespace nacre
