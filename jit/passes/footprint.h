#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace nacre {

/// The input channel that holds the derivative of input channel `channel`
/// along `axis` (0: x, 1: y) of the shading point's footprint, or nothing
/// where that derivative is zero. This is the one place where such channels
/// are named:
///
///   "<group>.<c>"  ->  "d<group>dx.<c>", "d<group>dy.<c>"
///   "<name>"       ->  "d<name>dx", "d<name>dy"   (a channel without components)
///
/// for the groups that have a footprint:
///
///   P, Pm, Po   position in world, model and object space: "P.x" -> "dPdx.x"
///   uv<i>       texture coordinates of set i: "uv0.y" -> "duv0dy.y"
///
/// and for `more`, the groups that the host declares to have one besides
/// ("N": normals whose change over the footprint is known). Every other input
/// (state, time, directions, identifiers) is the same all over the footprint.
/// Derivative channels themselves belong to no group: a footprint is affine.
std::optional<std::string> derivative_channel(std::string_view channel, int axis,
                                              std::span<const std::string_view> more = {});

}  // namespace nacre
