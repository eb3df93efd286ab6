#include "examples/common/atomic_file.h"

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "examples/common/partial_file.h"

namespace nacre::host {

namespace {

namespace fs = std::filesystem;

}  // namespace

bool write_failed(const std::string& path, const std::string& problem, Diagnostics& diagnostics) {
  diagnostics.error("cannot-write", {path, 0, 0, {}}, "the file could not be written", {}, problem);
  return false;
}

bool prepare_folder(const std::string& folder, Diagnostics& diagnostics) {
  std::error_code status;
  fs::create_directories(folder, status);
  const std::string problem = status ? status.message() : "";
  if (!fs::is_directory(folder, status)) {
    return write_failed(folder, "no such folder can be made: " + problem, diagnostics);
  }
  return ::access(folder.c_str(), W_OK | X_OK) == 0 ||
         write_failed(folder, std::generic_category().message(errno), diagnostics);
}

bool prepare_output(const std::string& path, Diagnostics& diagnostics) {
  const fs::path parent = fs::path(path).parent_path();
  if (!prepare_folder(parent.empty() ? "." : parent.string(), diagnostics)) return false;
  const std::string problem = PartialFile(path).problem();
  return problem.empty() || write_failed(path, problem, diagnostics);
}

bool write_atomically(const std::string& path,
                      const std::function<std::string(const std::string&)>& write,
                      Diagnostics& diagnostics) {
  PartialFile file(path);
  std::string problem = file.problem();
  if (problem.empty()) problem = write(file.name());
  if (problem.empty()) problem = file.commit();
  return problem.empty() || write_failed(path, problem, diagnostics);
}

bool write_text_atomically(const std::string& path, std::string_view text,
                           Diagnostics& diagnostics) {
  const auto write = [&](const std::string& name) -> std::string {
    std::ofstream stream(name, std::ios::binary | std::ios::trunc);
    stream.write(text.data(), static_cast<std::streamsize>(text.size()));
    stream.close();
    return stream ? "" : std::generic_category().message(errno);
  };
  return write_atomically(path, write, diagnostics);
}

}  // namespace nacre::host
