#pragma once

#include <optional>

#include "jit/glsl/componentwise.h"

/// Built-in functions of numbers, component by component (GLSL 4.60, 8.1 to 8.3, 8.14). Nothing
/// where the arguments do not fit.
namespace nacre::glsl::number {

std::optional<Value> glsl_radians(Arguments a);
std::optional<Value> glsl_degrees(Arguments a);
std::optional<Value> glsl_atan(Arguments a);
std::optional<Value> glsl_sinh(Arguments a);
std::optional<Value> glsl_cosh(Arguments a);
std::optional<Value> glsl_tanh(Arguments a);
std::optional<Value> glsl_pow(Arguments a);
std::optional<Value> glsl_inversesqrt(Arguments a);
std::optional<Value> glsl_abs(Arguments a);
std::optional<Value> glsl_sign(Arguments a);
std::optional<Value> glsl_min(Arguments a);
std::optional<Value> glsl_max(Arguments a);
std::optional<Value> glsl_clamp(Arguments a);
std::optional<Value> glsl_mix(Arguments a);
std::optional<Value> glsl_mod(Arguments a);
std::optional<Value> glsl_step(Arguments a);
std::optional<Value> glsl_smoothstep(Arguments a);
std::optional<Value> glsl_fma(Arguments a);
std::optional<Value> float_bits_to_int(Arguments a);
std::optional<Value> float_bits_to_uint(Arguments a);
std::optional<Value> bits_to_float(Arguments a);
std::optional<Value> glsl_isnan(Arguments a);
std::optional<Value> glsl_isinf(Arguments a);
std::optional<Value> ddx(Arguments a);
std::optional<Value> ddy(Arguments a);
std::optional<Value> glsl_fwidth(Arguments a);

}  // namespace nacre::glsl::number
