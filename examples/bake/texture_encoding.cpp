#include "examples/bake/texture_encoding.h"

#include "examples/bake/texture_format.h"
#include "jit/graph/color/colorspace.h"

namespace nacre::host {

std::string texture_colorspace(Type type, const std::string& extension,
                               const TextureEncoding& encoding) {
  if (type != Type::color3 && type != Type::color4) return {};
  if (!encoding.colorspace.empty()) return encoding.colorspace;
  return holds_unit_range_only(extension) ? "srgb_texture" : "lin_rec709";
}

std::string output_space(const std::string& extension, const TextureEncoding& encoding) {
  const std::string space = texture_colorspace(Type::color3, extension, encoding);
  if (is_srgb(space)) return "lin_rec709";
  return encoding.colorspace.empty() ? std::string() : space;
}

bool is_srgb(std::string_view colorspace) {
  return canonical_colorspace(colorspace) == "srgb_texture";
}

bool holds_unit_range_only(const std::string& extension) {
  const Format* format = format_of(extension);
  return format != nullptr && format->is_integer;
}

}  // namespace nacre::host
