#pragma once

#include <filesystem>
#include <vector>

namespace nacre {

/// The folders below which files must lie that a document names: its own, and those that
/// the user names. What counts is where a file really is, whatever ".." and symbolic links
/// say; whether it is there is never asked, so that no document learns it of others.
class FileRoots {
 public:
  /// "" is the current folder.
  void add(const std::filesystem::path& folder);
  /// Whether the file lies below one of them, there or not.
  bool hold(const std::filesystem::path& file) const;
  /// No folder was added, so nothing lies below.
  bool empty() const { return folders_.empty(); }

 private:
  std::vector<std::filesystem::path> folders_;
};

/// Without "..", "." and symbolic links; the path itself where the system refuses.
std::filesystem::path canonical_path(const std::filesystem::path& path);

}  // namespace nacre
