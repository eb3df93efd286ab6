#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "jit/glsl/type.h"

namespace nacre::glsl {

/// Component numbers of a swizzle, all letters of one set; empty if it is none.
std::vector<std::size_t> swizzle(std::string_view text, int rows);

/// Where member `text` of a structure starts among its scalars, and its type.
std::optional<std::pair<std::size_t, Type>> find_member(const Type& type, std::string_view text);

/// What [] gives: an array's element, a matrix's column, a vector's component.
std::optional<Type> element_type(const Type& type);
/// How many of them there are.
int element_count(const Type& type);

}  // namespace nacre::glsl
