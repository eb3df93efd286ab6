#include "jit/glsl/matrix.h"

namespace nacre::glsl::matrix {

namespace {

Ref& at(Value& matrix, int column, int row) {
  return matrix.parts[static_cast<std::size_t>(column * matrix.type.rows + row)];
}
Float at(const Value& matrix, int column, int row) {
  return matrix.number(static_cast<std::size_t>(column * matrix.type.rows + row));
}

/// The matrix without a column and a row.
Value minor(const Value& m, int column, int row) {
  Value result{m.type, {}, {}};
  result.type.rows = static_cast<std::uint8_t>(m.type.rows - 1);
  result.type.columns = result.type.rows;
  for (int c = 0; c < m.type.columns; ++c) {
    for (int r = 0; r < m.type.rows; ++r) {
      if (c != column && r != row) result.parts.push_back(at(m, c, r).ref());
    }
  }
  return result;
}

Float determinant_of(const Value& m) {
  if (m.type.rows == 1) return m.number(0);
  Float total = 0.0f;
  for (int column = 0; column < m.type.columns; ++column) {
    const Float term = at(m, column, 0) * determinant_of(minor(m, column, 0));
    total = column == 0 ? term : column % 2 == 0 ? total + term : total - term;
  }
  return total;
}

bool is_square(std::span<const Value> a) { return a.size() == 1 && a[0].type.is_matrix(); }

bool are_vectors(std::span<const Value> a) {
  return a.size() == 2 && a[0].type.is_float() && a[1].type == a[0].type && !a[0].type.is_matrix();
}

}  // namespace

std::optional<Value> determinant(std::span<const Value> a) {
  return is_square(a) ? std::optional(make(determinant_of(a[0]))) : std::nullopt;
}
std::optional<Value> transpose(std::span<const Value> a) {
  if (!is_square(a)) return std::nullopt;
  Value result = a[0];
  for (int c = 0; c < a[0].type.columns; ++c) {
    for (int r = 0; r < a[0].type.rows; ++r) at(result, r, c) = at(a[0], c, r).ref();
  }
  return result;
}
/// By cofactors.
std::optional<Value> inverse(std::span<const Value> a) {
  if (!is_square(a)) return std::nullopt;
  const Float scale = 1.0f / determinant_of(a[0]);
  Value result = a[0];
  for (int c = 0; c < a[0].type.columns; ++c) {
    for (int r = 0; r < a[0].type.rows; ++r) {
      const Float cofactor = determinant_of(minor(a[0], c, r)) * scale;
      at(result, r, c) = ((c + r) % 2 == 0 ? cofactor : -cofactor).ref();
    }
  }
  return result;
}
std::optional<Value> matrix_comp_mult(std::span<const Value> a) {
  if (a.size() != 2 || !a[0].type.is_matrix() || a[0].type != a[1].type) return std::nullopt;
  Value result = a[0];
  for (std::size_t i = 0; i < result.parts.size(); ++i) {
    result.parts[i] = (a[0].number(i) * a[1].number(i)).ref();
  }
  return result;
}
std::optional<Value> outer_product(std::span<const Value> a) {
  if (!are_vectors(a)) return std::nullopt;
  Value result{a[0].type, {}, {}};
  result.type.columns = a[1].type.rows;
  for (std::size_t c = 0; c < a[1].parts.size(); ++c) {
    for (std::size_t r = 0; r < a[0].parts.size(); ++r) {
      result.parts.push_back((a[0].number(r) * a[1].number(c)).ref());
    }
  }
  return result;
}

}  // namespace nacre::glsl::matrix
