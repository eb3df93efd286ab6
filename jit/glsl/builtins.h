#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "jit/glsl/value.h"

namespace nacre::glsl {

/// What calling a built-in function came to.
struct BuiltinResult {
  bool known = false;          ///< There is a function of that name.
  std::optional<Value> value;  ///< Nothing: not with these arguments.
};

/// Calls a built-in function (GLSL 4.60, chapter 8): trigonometric,
/// exponential, common, geometric, matrix, relational, bit conversions and
/// derivatives; none of images. Where GLSL leaves a result open, ours:
/// normalize of zero is zero; round goes to even; the rest is as
/// runtime/program/op.h says of its operations.
BuiltinResult call_builtin(std::string_view name, std::span<const Value> arguments);

bool is_builtin(std::string_view name);

}  // namespace nacre::glsl
