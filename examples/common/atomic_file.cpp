#include "examples/common/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>

namespace nacre::host {

namespace {

namespace fs = std::filesystem;

std::string temporary_name(const fs::path& path) {
  static std::atomic<unsigned> count = 0;
  const std::string name = "." + path.stem().string() + "." + std::to_string(getpid()) + "-" +
                           std::to_string(count++) + ".tmp" + path.extension().string();
  return (path.parent_path() / name).string();
}

/// Data reach the disk before the name does.
bool sync_file(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool ok = ::fsync(file) == 0;
  return ::close(file) == 0 && ok;
}

}  // namespace

bool write_atomically(const std::string& path,
                      const std::function<std::string(const std::string&)>& write,
                      Diagnostics& diagnostics) {
  const std::string temporary = temporary_name(path);
  std::error_code status;
  std::string problem = write(temporary);
  if (problem.empty() && !sync_file(temporary)) problem = "the data cannot be flushed";
  if (problem.empty()) {
    fs::rename(temporary, path, status);
    if (!status) return true;
    problem = status.message();
  }
  fs::remove(temporary, status);
  diagnostics.error("cannot-write", {path, 0, 0, {}}, "the file could not be written", {}, problem);
  return false;
}

}  // namespace nacre::host
