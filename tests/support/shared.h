#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace nacre::testing {

/// The folder of reference material that some tests read: NACRE_SHARED, or
/// ../shared beside the source tree. It may be missing; such tests then skip.
inline std::filesystem::path shared_folder() {
  if (const char* named = std::getenv("NACRE_SHARED"); named != nullptr && *named != '\0') {
    return named;
  }
  return std::filesystem::path(NACRE_SOURCE_DIR).parent_path() / "shared";
}

}  // namespace nacre::testing
