#include "examples/tool/paths.h"

#include <system_error>

namespace nacre::tool {

namespace fs = std::filesystem;

fs::path absolute_path(const fs::path& path) {
  std::error_code error;
  return fs::absolute(path, error).lexically_normal();
}

std::string from_folder(const fs::path& path, const fs::path& folder) {
  const std::string name = path.lexically_relative(folder).generic_string();
  return name.empty() ? path.generic_string() : name;
}

}  // namespace nacre::tool
