#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nacre {

/// The name by which the data library's transforms and `color_transform_text` call
/// a colour space: "acescg" for "lin_ap1_scene". "" for those that are not
/// converted (none, raw, data). A name that is not known comes back as it is.
std::string_view canonical_colorspace(std::string_view name);

/// All names that are known, of spaces without a conversion too.
std::vector<std::string_view> colorspace_names();

/// Row-major, for row vectors: rgb' = rgb M.
using ColorMatrix = std::array<std::array<double, 3>, 3>;

/// From the linear light of one space to that of another, both canonical; white
/// points are adapted by the Bradford method. Nothing if one is not known.
std::optional<ColorMatrix> color_matrix(std::string_view from, std::string_view to);

/// The nodedefs ND_<name>_color3 and _color4 of a transform, as text.
std::string color_transform_nodedefs(std::string_view name);

/// A document with nodedefs ND_<from>_to_<to>_color3 and _color4 and the graphs
/// that implement them by nodes of the standard library, for pairs that the data
/// library lacks. Decoding and encoding take the negative for zero, as the
/// library's own transforms do. Empty if one of the spaces is not known.
std::string color_transform_text(std::string_view from, std::string_view to);

/// The same as a function "vec3 NAME(vec3)" in GLSL.
std::string color_transform_glsl(std::string_view from, std::string_view to,
                                 std::string_view function);

}  // namespace nacre
