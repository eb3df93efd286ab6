#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace nacre::host {

/// A new file that remembers what went wrong first: a full disk must not look like an image.
class FileBytes {
 public:
  explicit FileBytes(const std::string& path);
  ~FileBytes();
  FileBytes(const FileBytes&) = delete;
  FileBytes& operator=(const FileBytes&) = delete;

  /// What was written so far, in bytes.
  std::uint64_t size() const { return size_; }
  /// At the end. False once anything went wrong.
  bool append(std::span<const unsigned char> bytes);
  /// Over what is there already, from byte `offset` on.
  bool replace(std::uint64_t offset, std::span<const unsigned char> bytes);
  /// Ends the file: what went wrong first since it was opened, or "".
  std::string finish();
  /// What went wrong first, or "".
  const std::string& problem() const { return problem_; }

 private:
  void fail(int error);

  int file_;
  std::uint64_t size_ = 0;
  std::string problem_;
};

}  // namespace nacre::host
