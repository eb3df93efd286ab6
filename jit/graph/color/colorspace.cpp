#include "jit/graph/color/colorspace.h"

#include <algorithm>
#include <array>

namespace nacre {

namespace {

struct Alias {
  std::string_view name;
  std::string_view canonical;
};

// Names that MaterialX 1.39's default colour management takes for its own; the
// Color Interop Forum's ("Color Space Encodings for Texture Assets and CG Rendering",
// ASWF 2024: compact and full names); and common names of OCIO configurations.
constexpr std::array aliases = std::to_array<Alias>({
    {"none", ""},
    {"raw", ""},
    {"Raw", ""},
    {"data", ""},
    {"identity", ""},
    {"gamma18", "g18_rec709"},
    {"gamma22", "g22_rec709"},
    {"gamma24", "rec709_display"},
    {"lin_ap1", "acescg"},
    {"lin_ap1_scene", "acescg"},
    {"ACEScg", "acescg"},
    {"lin_ap0_scene", "lin_ap0"},
    {"ACES2065-1", "lin_ap0"},
    {"aces2065_1", "lin_ap0"},
    {"lin_rec709_scene", "lin_rec709"},
    {"lin_srgb", "lin_rec709"},
    {"Linear Rec.709 (sRGB)", "lin_rec709"},
    {"lin_rec2020_scene", "lin_rec2020"},
    {"Linear Rec.2020", "lin_rec2020"},
    {"lin_ciexyzd65_scene", "lin_ciexyzd65"},
    {"CIE XYZ-D65 - Scene-referred", "lin_ciexyzd65"},
    {"srgb_rec709_scene", "srgb_texture"},
    {"srgb_tx", "srgb_texture"},
    {"Utility - sRGB - Texture", "srgb_texture"},
    {"sRGB Encoded Rec.709 (sRGB)", "srgb_texture"},
    {"sRGB - Texture", "srgb_texture"},
    {"srgb_ap1_scene", "srgb_ap1"},
    {"sRGB Encoded AP1", "srgb_ap1"},
    {"g18_rec709_scene", "g18_rec709"},
    {"Gamma 1.8 Encoded Rec.709", "g18_rec709"},
    {"g22_rec709_scene", "g22_rec709"},
    {"Gamma 2.2 Encoded Rec.709", "g22_rec709"},
    {"g24_rec709_scene", "rec709_display"},
    {"Gamma 2.4 Encoded Rec.709", "rec709_display"},
    {"g22_ap1_scene", "g22_ap1"},
    {"Gamma 2.2 Encoded AP1", "g22_ap1"},
    {"g22_adobergb_scene", "adobergb"},
    {"Gamma 2.2 Encoded AdobeRGB", "adobergb"},
    {"lin_adobergb_scene", "lin_adobergb"},
    {"Linear AdobeRGB", "lin_adobergb"},
    {"lin_p3d65_scene", "lin_displayp3"},
    {"lin_p3d65", "lin_displayp3"},
    {"Linear P3-D65", "lin_displayp3"},
    {"srgb_p3d65_scene", "srgb_displayp3"},
    {"sRGB Encoded P3-D65", "srgb_displayp3"},
});

}  // namespace

std::string_view canonical_colorspace(std::string_view name) {
  for (const Alias& alias : aliases) {
    if (alias.name == name) return alias.canonical;
  }
  return name;
}

std::vector<std::string_view> colorspace_names() {
  std::vector<std::string_view> names;
  for (const Alias& alias : aliases) {
    for (const std::string_view name : {alias.name, alias.canonical}) {
      if (!name.empty() && std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

}  // namespace nacre
