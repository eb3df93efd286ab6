#include "examples/image_writer/checked_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace nacre::host {

CheckedFile::CheckedFile(const std::string& path)
    : IOProxy(path, Write),
      file_(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
  if (file_ < 0) problem_ = std::generic_category().message(errno);
}

CheckedFile::~CheckedFile() {
  if (file_ >= 0) ::close(file_);
}

std::string CheckedFile::finish() {
  if (file_ >= 0 && ::close(file_) != 0 && problem_.empty()) {
    problem_ = std::generic_category().message(errno);
  }
  file_ = -1;
  return problem_;
}

std::size_t CheckedFile::write(const void* bytes, std::size_t size) {
  const std::size_t written = pwrite(bytes, size, m_pos);
  m_pos += static_cast<std::int64_t>(written);
  return written;
}

std::size_t CheckedFile::pwrite(const void* bytes, std::size_t size, std::int64_t offset) {
  std::size_t done = 0;
  while (done < size) {
    const ssize_t written = ::pwrite(file_, static_cast<const char*>(bytes) + done, size - done,
                                     offset + static_cast<std::int64_t>(done));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      if (problem_.empty()) problem_ = std::generic_category().message(errno);
      break;
    }
    done += static_cast<std::size_t>(written);
  }
  return done;
}

std::size_t CheckedFile::size() const {
  struct stat status{};
  return ::fstat(file_, &status) == 0 ? static_cast<std::size_t>(status.st_size) : 0;
}

}  // namespace nacre::host
