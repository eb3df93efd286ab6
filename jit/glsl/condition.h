#pragma once

#include <optional>
#include <span>

#include "jit/glsl/token.h"

namespace nacre::glsl {

/// The value of what stands behind #if once macros are expanded: whole numbers with || &&
/// == != < > <= >= + - ! and parentheses; names are 0 (GLSL 4.60, 3.3). Nothing for what is
/// no such expression.
std::optional<long long> evaluate_condition(std::span<const Token> tokens);

}  // namespace nacre::glsl
