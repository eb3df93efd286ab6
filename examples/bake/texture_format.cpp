#include "examples/bake/texture_format.h"

#include <array>

namespace nacre::host {

const Format* format_of(std::string_view extension) {
  using enum SampleType;
  constexpr auto none = std::nullopt;
  static const std::array formats = std::to_array<Format>({
      {".exr", ImageKind::exr, 32, none, half, floating, false},
      {".png", ImageKind::png, 8, unsigned8, unsigned16, none, true},
      {".tx", ImageKind::tx, 32, none, half, floating, false},
  });
  for (const Format& format : formats) {
    if (format.extension == extension) return &format;
  }
  return nullptr;
}

std::optional<SampleType> type_of(const Format& format, int bits) {
  switch (bits == 0 ? format.default_bits : bits) {
    case 8: return format.of_8;
    case 16: return format.of_16;
    case 32: return format.of_32;
    default: return std::nullopt;
  }
}

}  // namespace nacre::host
