#include "examples/common/output_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace nacre::host {

bool prepare_output_file(const std::string& path, Diagnostics& diagnostics) {
  namespace fs = std::filesystem;
  const auto fail = [&](const char* expected, const std::string& found) {
    diagnostics.error("cannot-write", {path, 0, 0, {}}, "the file cannot be written", expected,
                      found);
    return false;
  };
  std::error_code status;
  const fs::file_type type = fs::status(path, status).type();
  if (type != fs::file_type::not_found && type != fs::file_type::regular &&
      type != fs::file_type::none) {
    return fail("the name of a file", type == fs::file_type::directory ? "a folder" : "no file");
  }
  fs::path folder = fs::path(path).parent_path();
  if (folder.empty()) folder = ".";
  fs::create_directories(folder, status);
  if (status) return fail("a folder that can be made", folder.string() + ": " + status.message());
  // Only a file that is made shows that one can be: rights are not all there is to it.
  std::string probe = (folder / ".nacre-XXXXXX").string();
  const int file = ::mkstemp(probe.data());
  if (file < 0) {
    return fail("a folder that can be written to",
                folder.string() + ": " + std::generic_category().message(errno));
  }
  ::close(file);
  ::unlink(probe.c_str());
  return true;
}

}  // namespace nacre::host
