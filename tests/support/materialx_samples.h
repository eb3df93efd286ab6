#pragma once

#include <cstdlib>
#include <filesystem>

namespace nacre {

/// A file or folder of MaterialX's own examples, such as "Materials/Examples": what its source
/// tree has in resources/, as materialx/ in the folder that NACRE_SHARED names, or in ../shared
/// beside ours. With their images they are too large for this project and the download of the
/// data library has none, so this may be empty; tests that need it then skip.
inline std::filesystem::path materialx_sample(const char* name) {
  const char* named = std::getenv("NACRE_SHARED");
  const std::filesystem::path root =
      named != nullptr && *named != '\0'
          ? std::filesystem::path(named)
          : std::filesystem::path(NACRE_SOURCE_DIR).parent_path() / "shared";
  const std::filesystem::path sample = root / "materialx" / name;
  std::error_code ignored;
  return std::filesystem::exists(sample, ignored) ? sample : std::filesystem::path();
}

}  // namespace nacre
