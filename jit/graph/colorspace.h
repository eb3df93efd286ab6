#pragma once

#include <string_view>

namespace nacre {

/// The name the library's transforms use for a colour space: "srgb_texture" for
/// "Utility - sRGB - Texture". Empty for those that mean "leave the numbers
/// alone": "none", "raw", "data". Names it does not know come back unchanged.
std::string_view canonical_colorspace(std::string_view name);

}  // namespace nacre
