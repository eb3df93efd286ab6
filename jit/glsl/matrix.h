#pragma once

#include <optional>
#include <span>

#include "jit/glsl/value.h"

/// The built-in functions of matrices (GLSL 4.60, 8.6). Nothing where the
/// arguments do not fit.
namespace nacre::glsl::matrix {

std::optional<Value> determinant(std::span<const Value> a);
std::optional<Value> transpose(std::span<const Value> a);
/// By cofactors; a singular matrix gives infinities and NaN.
std::optional<Value> inverse(std::span<const Value> a);
/// Component by component.
std::optional<Value> matrix_comp_mult(std::span<const Value> a);
/// Column times row.
std::optional<Value> outer_product(std::span<const Value> a);

}  // namespace nacre::glsl::matrix
