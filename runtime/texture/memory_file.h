#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace nacre {

/// A file that lies in memory alone, for readers that want a path.
class MemoryFile {
 public:
  /// A path that leads to no file.
  static constexpr const char* nowhere = "/proc/self/fd/none";

  /// Null, with errno, where the system has no room for it.
  static std::shared_ptr<const MemoryFile> create(std::string_view bytes);
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  /// Leads to it in this process, as long as it lives.
  const std::string& path() const { return path_; }

 private:
  explicit MemoryFile(int descriptor);

  int descriptor_;
  std::string path_;
};

}  // namespace nacre
