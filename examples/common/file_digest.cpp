#include "examples/common/file_digest.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <vector>

namespace nacre::host {

namespace {

/// An open file, closed at the end.
struct Open {
  explicit Open(const std::string& path)
      : file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
  ~Open() {
    if (file >= 0) ::close(file);
  }
  Open(const Open&) = delete;
  Open& operator=(const Open&) = delete;

  int file;
};

}  // namespace

std::optional<Digest> digest_of_file(const std::string& path, FileIdentity* identity) {
  const Open open(path);
  struct stat before{};
  if (open.file < 0 || ::fstat(open.file, &before) != 0 || !S_ISREG(before.st_mode)) return {};
  Sha256 digest;
  std::vector<char> bytes(std::size_t{1} << 20);
  while (true) {
    const ssize_t count = ::read(open.file, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return {};
    if (count == 0) break;
    digest.add({bytes.data(), static_cast<std::size_t>(count)});
  }
  struct stat after{};
  const bool same = ::fstat(open.file, &after) == 0 && identity_of(after) == identity_of(before);
  if (!same) return {};
  if (identity != nullptr) *identity = identity_of(before);
  return digest.finish();
}

}  // namespace nacre::host
