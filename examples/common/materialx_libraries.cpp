#include "examples/common/materialx_libraries.h"

#include <cstdlib>
#include <system_error>

namespace nacre {
namespace {

bool has_library(const std::filesystem::path& folder) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(folder / "stdlib" / "stdlib_defs.mtlx", ignored);
}

std::filesystem::path running_program() {
  std::error_code ignored;
  return std::filesystem::read_symlink("/proc/self/exe", ignored);
}

}  // namespace

std::filesystem::path find_materialx_libraries(const char* environment,
                                               const std::filesystem::path& program,
                                               const std::filesystem::path& built_with) {
  if (environment != nullptr && *environment != '\0') {
    return has_library(environment) ? std::filesystem::path(environment) : std::filesystem::path();
  }
  const std::filesystem::path prefix = program.parent_path().parent_path();
  for (const auto& folder : {prefix / "share" / "nacre" / "libraries", built_with}) {
    if (has_library(folder)) return folder;
  }
  return {};
}

std::filesystem::path find_materialx_libraries() {
  return find_materialx_libraries(std::getenv("NACRE_MATERIALX_LIBRARIES"), running_program(),
                                  NACRE_MATERIALX_LIBRARIES_DIR);
}

}  // namespace nacre
