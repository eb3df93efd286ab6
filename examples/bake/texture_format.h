#pragma once

#include <OpenImageIO/typedesc.h>

#include <string_view>

namespace nacre::host {

/// What files of one extension can hold.
struct Format {
  std::string_view extension;  ///< ".exr"
  const char* plugin;          ///< As OpenImageIO calls it.
  int default_bits;
  OIIO::TypeDesc of_8, of_16, of_32;  ///< UNKNOWN where it cannot.
  bool is_integer;
};

/// Null for extensions that are not written.
const Format* format_of(std::string_view extension);

/// The type of a channel of so many bits, 0: as many as usual; UNKNOWN if there is none.
OIIO::TypeDesc type_of(const Format& format, int bits);

}  // namespace nacre::host
