#include "examples/encode/file_bytes.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace nacre::host {

FileBytes::FileBytes(const std::string& path)
    : file_(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
  if (file_ < 0) fail(errno);
}

FileBytes::~FileBytes() {
  if (file_ >= 0) ::close(file_);
}

bool FileBytes::append(std::span<const unsigned char> bytes) {
  const std::uint64_t offset = size_;
  size_ += bytes.size();
  return replace(offset, bytes);
}

bool FileBytes::replace(std::uint64_t offset, std::span<const unsigned char> bytes) {
  while (problem_.empty() && !bytes.empty()) {
    const ssize_t written = ::pwrite(file_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      fail(written < 0 ? errno : ENOSPC);
      break;
    }
    bytes = bytes.subspan(static_cast<std::size_t>(written));
    offset += static_cast<std::uint64_t>(written);
  }
  return problem_.empty();
}

std::string FileBytes::finish() {
  if (file_ >= 0 && ::close(file_) != 0) fail(errno);
  file_ = -1;
  return problem_;
}

void FileBytes::fail(int error) {
  if (problem_.empty()) problem_ = std::generic_category().message(error);
}

}  // namespace nacre::host
