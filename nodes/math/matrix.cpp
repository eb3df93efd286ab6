#include "nodes/math/matrix.h"

#include <cassert>
#include <utility>

#include "nodes/math/safe.h"

namespace nacre {

namespace {

/// a b - c d without the cancellation of rounding each product: Jeannerod,
/// Louvet, Muller, "Further analysis of Kahan's algorithm", 2013.
Float difference_of_products(Float a, Float b, Float c, Float d) {
  const Float cd = c * d;
  return fma(a, b, -cd) + fma(-c, d, cd);
}

/// Determinant of rows i, j and columns k, l.
Float minor2(const Matrix& m, int i, int j, int k, int l) {
  return difference_of_products(m(i, k), m(j, l), m(i, l), m(j, k));
}

/// The transposed cofactors, so that m adjugate(m) = determinant(m) identity.
Matrix adjugate3(const Matrix& m) {
  Matrix result(3);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      // Cyclic indices carry the sign of the cofactor.
      result(column, row) =
          minor2(m, (row + 1) % 3, (row + 2) % 3, (column + 1) % 3, (column + 2) % 3);
    }
  }
  return result;
}

Float determinant3(const Matrix& m) {
  return fma(m(0, 0), minor2(m, 1, 2, 1, 2),
             fma(m(0, 1), minor2(m, 1, 2, 2, 0), m(0, 2) * minor2(m, 1, 2, 0, 1)));
}

/// m without one row and one column.
Matrix without(const Matrix& m, int row, int column) {
  Matrix result(3);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result(i, j) = m(i + (i >= row), j + (j >= column));
  }
  return result;
}

Matrix adjugate4(const Matrix& m) {
  Matrix result(4);
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      const Float minor = determinant3(without(m, row, column));
      result(column, row) = (row + column) % 2 == 0 ? minor : -minor;
    }
  }
  return result;
}

Matrix adjugate(const Matrix& m) { return m.size == 3 ? adjugate3(m) : adjugate4(m); }

Float determinant_from(const Matrix& m, const Matrix& adjugate) {
  Float sum = m(0, 0) * adjugate(0, 0);
  for (int k = 1; k < m.size; ++k) sum = fma(m(0, k), adjugate(k, 0), sum);
  return sum;
}

}  // namespace

Matrix matrix_input(const NodeCall& call, std::string_view name) {
  const Recorded& value = call.in(name);
  assert(is_matrix(value.type));
  Matrix result(value.type == Type::matrix33 ? 3 : 4);
  for (std::size_t i = 0; i < value.parts.size(); ++i) result.entries[i] = value.number(i);
  return result;
}

void set_matrix(NodeCall& call, const Matrix& m) {
  std::vector<Ref> parts;
  for (const Float& entry : m.entries) parts.push_back(entry.ref());
  call.set(std::move(parts));
}

bool is_matrix(Type type) { return type == Type::matrix33 || type == Type::matrix44; }

Matrix identity(int size) {
  Matrix result(size);
  for (int i = 0; i < size; ++i) result(i, i) = 1.0f;
  return result;
}

Matrix operator*(const Matrix& a, const Matrix& b) {
  Matrix result(a.size);
  for (int row = 0; row < a.size; ++row) {
    for (int column = 0; column < a.size; ++column) {
      Float sum = a(row, 0) * b(0, column);
      for (int k = 1; k < a.size; ++k) sum = fma(a(row, k), b(k, column), sum);
      result(row, column) = sum;
    }
  }
  return result;
}

Matrix transpose(const Matrix& m) {
  Matrix result(m.size);
  for (int row = 0; row < m.size; ++row) {
    for (int column = 0; column < m.size; ++column) result(column, row) = m(row, column);
  }
  return result;
}

Float determinant(const Matrix& m) {
  return m.size == 3 ? determinant3(m) : determinant_from(m, adjugate4(m));
}

Matrix inverse(const Matrix& m) {
  Matrix result = adjugate(m);
  const Float det = determinant_from(m, result);
  const Bool regular = (det != 0.0f) & (abs(det) <= float_max);
  const Matrix one = identity(m.size);
  for (std::size_t i = 0; i < result.entries.size(); ++i) {
    result.entries[i] = select(regular, result.entries[i] / det, one.entries[i]);
  }
  return result;
}

std::vector<Float> transform(const std::vector<Float>& v, const Matrix& m) {
  std::vector<Float> result;
  for (int column = 0; column < m.size; ++column) {
    Float sum = v[0] * m(0, column);
    for (int row = 1; row < m.size; ++row) {
      sum = fma(v[static_cast<std::size_t>(row)], m(row, column), sum);
    }
    result.push_back(sum);
  }
  return result;
}

}  // namespace nacre
