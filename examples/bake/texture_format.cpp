#include "examples/bake/texture_format.h"

#include <array>

namespace nacre::host {

const Format* format_of(std::string_view extension) {
  using OIIO::TypeDesc;
  constexpr TypeDesc unknown = TypeDesc::UNKNOWN;
  static const std::array formats = std::to_array<Format>({
      {".exr", "openexr", 32, unknown, TypeDesc::HALF, TypeDesc::FLOAT, false},
      {".png", "png", 8, TypeDesc::UINT8, TypeDesc::UINT16, unknown, true},
      {".tx", "tiff", 32, unknown, TypeDesc::HALF, TypeDesc::FLOAT, false},
  });
  for (const Format& format : formats) {
    if (format.extension == extension) return &format;
  }
  return nullptr;
}

OIIO::TypeDesc type_of(const Format& format, int bits) {
  switch (bits == 0 ? format.default_bits : bits) {
    case 8: return format.of_8;
    case 16: return format.of_16;
    case 32: return format.of_32;
    default: return OIIO::TypeDesc::UNKNOWN;
  }
}

}  // namespace nacre::host
