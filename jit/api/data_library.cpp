#include <dlfcn.h>
#include <nacre/nacre.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace nacre::api {

namespace {

namespace fs = std::filesystem;

bool has_library(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_regular_file(folder / "stdlib" / "stdlib_defs.mtlx", ignored);
}

/// From the place of the library, or of the program that has it inside: "" if it is not there.
std::string find() {
  if (const char* named = std::getenv("NACRE_MATERIALX_LIBRARIES");
      named != nullptr && *named != '\0') {
    // When set it is the only answer, so that a wrong value is noticed.
    return has_library(named) ? std::string(named) : std::string();
  }
  Dl_info here{};
  if (::dladdr(reinterpret_cast<const void*>(&nacre_data_library), &here) == 0) return {};
  std::error_code ignored;
  const fs::path folder = fs::weakly_canonical(here.dli_fname, ignored).parent_path();
  // From lib and lib/x86_64-linux-gnu; from a build, where the configured one is.
  for (const std::string_view up : {"../share", "../../share"}) {
    const fs::path place = (folder / up / "nacre" / "libraries").lexically_normal();
    if (has_library(place)) return place;
  }
  return has_library(NACRE_MATERIALX_LIBRARIES_DIR) ? NACRE_MATERIALX_LIBRARIES_DIR : "";
}

}  // namespace

}  // namespace nacre::api

const char* nacre_data_library(void) {
  static const std::string folder = nacre::api::find();
  return folder.c_str();
}
