#pragma once

#include <string_view>
#include <vector>

#include "runtime/node/node_call.h"

namespace nacre {

/// A recorded square matrix, three or four rows. MaterialX multiplies row
/// vectors from the left: v' = v M.
struct Matrix {
  int size;
  std::vector<Float> entries;  ///< Row by row.

  explicit Matrix(int rows) : size(rows), entries(static_cast<std::size_t>(rows * rows)) {}
  Float& operator()(int row, int column) {
    return entries[static_cast<std::size_t>(row * size + column)];
  }
  Float operator()(int row, int column) const {
    return entries[static_cast<std::size_t>(row * size + column)];
  }
};

/// The matrix on an input of type matrix33 or matrix44.
Matrix matrix_input(const NodeCall& call, std::string_view name);
/// Sets the first output.
void set_matrix(NodeCall& call, const Matrix& m);

bool is_matrix(Type type);
Matrix identity(int size);
Matrix operator*(const Matrix& a, const Matrix& b);
Matrix transpose(const Matrix& m);
Float determinant(const Matrix& m);
/// The inverse; the identity where the determinant is zero or not finite.
Matrix inverse(const Matrix& m);

/// v M for a vector with as many components as M has rows.
std::vector<Float> transform(const std::vector<Float>& v, const Matrix& m);

}  // namespace nacre
