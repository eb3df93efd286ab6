#include "examples/render/scene_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace nacre::host {

namespace {

class File {
 public:
  // Not blocking: opening a pipe must not wait for its other end.
  explicit File(const std::string& path)
      : number_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {}
  ~File() {
    if (number_ >= 0) ::close(number_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

std::string reason() { return std::generic_category().message(errno); }

}  // namespace

std::optional<std::string> read_scene_file(const std::string& path, const SourceLocation& where,
                                           std::size_t& budget, Diagnostics& diagnostics) {
  const File file(path);
  struct stat status{};
  if (file.number() < 0 || ::fstat(file.number(), &status) != 0) {
    diagnostics.error("cannot-read", where, "the file cannot be opened", "a file that is there",
                      fmt::format("{}: {}", path, reason()));
    return {};
  }
  if (!S_ISREG(status.st_mode)) {
    diagnostics.error("cannot-read", where, "this is not a regular file", "a regular file", path);
    return {};
  }
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size > budget) {
    diagnostics.error("file-too-large", where, "the files of the scene are too large",
                      fmt::format("at most {} bytes more (--max-scene-file-size)", budget),
                      fmt::format("{} bytes in {}", size, path));
    return {};
  }
  std::string bytes(size, '\0');
  std::size_t done = 0;
  while (done < size) {
    const ssize_t count = ::read(file.number(), bytes.data() + done, size - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      diagnostics.error("cannot-read", where, "the file cannot be read", {},
                        fmt::format("{}: {}", path, reason()));
      return {};
    }
    if (count == 0) break;  // Shorter than it was.
    done += static_cast<std::size_t>(count);
  }
  bytes.resize(done);
  budget -= done;
  return bytes;
}

}  // namespace nacre::host
