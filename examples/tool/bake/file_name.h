#pragma once

#include <string>

#include "runtime/diagnostic.h"

namespace nacre::tool {

/// How images are called: a text with {output}, {udim} and {ext} in braces.
inline constexpr const char* default_file_name = "{output}.{udim}.{ext}";

/// False, with an error, for a name in which images of several outputs, or of several tiles, would
/// be one, that has another field, that leads to another folder, or does not end in ".{ext}".
bool check_file_name(const std::string& name, bool has_tiles, Diagnostics& diagnostics);

/// `extension` with its dot. No tile, "": that field goes, with the '.', '_' or '-' before it.
std::string file_name(const std::string& name, const std::string& output, const std::string& tile,
                      const std::string& extension);

}  // namespace nacre::tool
