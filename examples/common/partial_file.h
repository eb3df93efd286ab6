#pragma once

#include <string>

namespace nacre::host {

/// A file on its way: it is written in a folder of its own beside its place, and gets its
/// name only once it is whole. The folder ".nacre-XXXXXX" is locked (flock) for as long as
/// its process lives, so what a killed one left is known by having no lock: the next
/// partial file beside it takes that away.
class PartialFile {
 public:
  /// For a file that is to be at `path`, in a folder that exists.
  explicit PartialFile(std::string path);
  /// Removes what was not committed.
  ~PartialFile();
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  /// Why it cannot be written, or "".
  const std::string& problem() const { return problem_; }
  const std::string& path() const { return path_; }
  /// Where to write; the last part is that of `path`, so that the extension is too.
  const std::string& name() const { return name_; }
  /// Has the data reach the disk, then gives the file its name. Why that failed, or "".
  std::string commit();

 private:
  void remove();

  std::string path_;
  std::string folder_;  ///< "" once it is gone.
  std::string name_;
  std::string problem_;
  int lock_ = -1;
};

/// Takes away what killed processes have left in a folder.
void sweep_partial_files(const std::string& folder);

/// Removes the partial files of this process for good: whatever would make, name or remove
/// one waits from then on. For a process that is about to end while threads still work.
void abandon_partial_files();

}  // namespace nacre::host
