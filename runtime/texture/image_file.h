#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "runtime/diagnostic.h"
#include "runtime/texture/file_identity.h"
#include "runtime/texture/image_format.h"
#include "runtime/texture/image_limits.h"

namespace nacre {

/// A regular file, open for reading, that begins like an image: the only way to a file's
/// bytes for all that reads images. Opening waits for nobody, so a pipe is refused and
/// does not hang.
class ImageFile {
 public:
  /// Null, with the reason in `error`: missing-image, unreadable-image (no regular file,
  /// no permission, empty), image-too-large or unsupported-image.
  static std::shared_ptr<const ImageFile> open(const std::string& path, const ImageLimits& limits,
                                               Diagnostic& error);
  ~ImageFile();
  ImageFile(const ImageFile&) = delete;
  ImageFile& operator=(const ImageFile&) = delete;

  const std::string& path() const { return path_; }
  ImageFormat format() const { return format_; }
  const FileIdentity& identity() const { return identity_; }
  std::uint64_t bytes() const { return identity_.bytes; }
  int descriptor() const { return descriptor_; }

  /// Up to `count` bytes from `at`; how many there were.
  std::size_t read(std::uint64_t at, char* to, std::size_t count) const;

 private:
  ImageFile(std::string path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}

  std::string path_;
  int descriptor_;
  FileIdentity identity_;
  ImageFormat format_ = ImageFormat::exr;
};

/// Reads a file from front to back in small steps.
class FileCursor {
 public:
  explicit FileCursor(const ImageFile& file, std::uint64_t at = 0) : file_(file), at_(at) {}

  std::uint64_t at() const { return at_; }
  std::uint64_t left() const { return at_ < file_.bytes() ? file_.bytes() - at_ : 0; }
  void skip(std::uint64_t count) { at_ += count; }
  /// Exactly `count` bytes in place of what `bytes` holds; false where there are fewer.
  bool take(std::uint64_t count, std::string& bytes);

 private:
  const ImageFile& file_;
  std::uint64_t at_;
  std::string buffer_;
  std::uint64_t buffer_at_ = 0;
};

}  // namespace nacre
