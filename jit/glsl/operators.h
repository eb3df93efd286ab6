#pragma once

#include <optional>
#include <string_view>

#include "jit/glsl/value.h"

namespace nacre::glsl {

/// `a op b` for every operator but assignments, ',' and the look-ahead of &&
/// and ||; GLSL 4.60, 5.9. A scalar meets a vector or matrix component by
/// component, '*' between vectors and matrices is that of linear algebra.
/// Whole numbers: x / 0 and x % 0 are 0; '%' has the sign of a. Nothing if the
/// operands do not go together.
std::optional<Value> binary(std::string_view op, const Value& a, const Value& b);

/// + - ! ~
std::optional<Value> unary(std::string_view op, const Value& a);

/// columns x rows of a matrix product, a matrix and a vector either way.
Value multiply(const Value& a, const Value& b);

/// One truth value: equal in all parts.
Bool equal(const Value& a, const Value& b);

}  // namespace nacre::glsl
