#include <nacre/nacre.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include "runtime/own_file.h"

namespace nacre::api {

namespace {

namespace fs = std::filesystem;

/// What every data library has.
constexpr const char* known_file = "stdlib/stdlib_defs.mtlx";

/// From the place of the library, or of the program that has it inside: "" if it is not there.
std::string find() {
  if (const char* named = std::getenv("NACRE_MATERIALX_LIBRARIES");
      named != nullptr && *named != '\0') {
    // When set it is the only answer, so that a wrong value is noticed.
    std::error_code ignored;
    return fs::is_regular_file(fs::path(named) / known_file, ignored) ? named : "";
  }
  // A build uses the one that it was configured with.
  const fs::path found = find_own_file({fs::path("share/nacre/libraries") / known_file,
                                        fs::path(NACRE_MATERIALX_LIBRARIES_DIR) / known_file});
  return found.parent_path().parent_path();
}

}  // namespace

}  // namespace nacre::api

const char* nacre_data_library(void) {
  static const std::string folder = nacre::api::find();
  return folder.c_str();
}
