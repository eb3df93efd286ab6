#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "jit/document/element.h"

namespace nacre {

/// The elements of a list of geometry names, trimmed; commas within braces belong to
/// the name around them.
std::vector<std::string_view> split_geom_list(std::string_view text);

/// A list of geometry names that an element writes, with the geomprefix around it
/// before each.
std::string geom_list(const Element& element, std::string_view attribute);

/// True if a name ("/a/b/c") is what a geometry name expression stands for (MaterialX
/// 1.39 Geometry Extensions, "Geometry Name Expressions"): "*", "?", "[a-c]" and
/// "{x,y}" within one level, "//" for any number of levels. "//*" at the end takes
/// leaves only, and "//" at the end every level. Names without a leading "/" stand at
/// the top. An expression with more than 1024 alternatives matches nothing.
bool geom_matches(std::string_view expression, std::string_view name, bool is_leaf = true);

/// The path above: "/a" of "/a/b", "/" of "/a", "" of "/".
std::string_view parent_geom(std::string_view name);

}  // namespace nacre
