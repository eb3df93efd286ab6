#pragma once

#include <optional>
#include <string_view>

#include "examples/common/image_writer.h"

namespace nacre::host {

/// What files of one extension can hold.
struct Format {
  std::string_view extension;  ///< ".exr"
  ImageKind kind;
  int default_bits;
  std::optional<SampleType> of_8, of_16, of_32;  ///< Nothing where it cannot.
  bool is_integer;
};

/// Null for extensions that are not written.
const Format* format_of(std::string_view extension);

/// The type of a channel of so many bits, 0: as many as usual; nothing if there is none.
std::optional<SampleType> type_of(const Format& format, int bits);

}  // namespace nacre::host
