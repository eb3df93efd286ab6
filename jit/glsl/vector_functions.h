#pragma once

#include <optional>

#include "jit/glsl/componentwise.h"

/// Built-in functions of vectors and their relations (GLSL 4.60, 8.5, 8.7). Nothing where the
/// arguments do not fit.
namespace nacre::glsl::vector {

std::optional<Value> glsl_dot(Arguments a);
std::optional<Value> glsl_length(Arguments a);
std::optional<Value> glsl_distance(Arguments a);
std::optional<Value> glsl_normalize(Arguments a);
std::optional<Value> glsl_cross(Arguments a);
std::optional<Value> glsl_reflect(Arguments a);
std::optional<Value> glsl_refract(Arguments a);
std::optional<Value> glsl_faceforward(Arguments a);
std::optional<Value> less_than(Arguments a);
std::optional<Value> less_than_equal(Arguments a);
std::optional<Value> greater_than(Arguments a);
std::optional<Value> greater_than_equal(Arguments a);
std::optional<Value> glsl_equal(Arguments a);
std::optional<Value> not_equal(Arguments a);
std::optional<Value> glsl_any(Arguments a);
std::optional<Value> glsl_all(Arguments a);
std::optional<Value> glsl_not(Arguments a);

}  // namespace nacre::glsl::vector
