#include <vector>

#include "nodes/math/matrix.h"

namespace nacre {

/// in mat, the vector as a row. MaterialX 1.39 Standard Nodes, "transformmatrix".
/// A vector one component short of the matrix is a point: 1 is appended before
/// and the last component dropped after, without division by it. Edges: IEEE, see
/// safe.h.
void record_transformmatrix(NodeCall& call) {
  const Matrix m = matrix_input(call, "mat");
  const Recorded& input = call.in("in");
  std::vector<Float> v;
  for (std::size_t i = 0; i < input.parts.size(); ++i) v.push_back(input.number(i));
  v.resize(static_cast<std::size_t>(m.size), 1.0f);
  std::vector<Ref> parts;
  for (const Float& component : transform(v, m)) parts.push_back(component.ref());
  parts.resize(input.parts.size());
  call.set(std::move(parts));
}

}  // namespace nacre
