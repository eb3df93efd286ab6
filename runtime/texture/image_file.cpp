#include "runtime/texture/image_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <span>
#include <system_error>

namespace nacre {

namespace {

std::string reason(int number) { return std::generic_category().message(number); }

std::int64_t nanoseconds(const timespec& time) {
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

Diagnostic cannot_open(const std::string& path, int number) {
  if (number == ENOENT || number == ENOTDIR || number == ENAMETOOLONG) {
    return image_error("missing-image", path, "the image does not exist");
  }
  return image_error("unreadable-image", path, "the image cannot be opened", {}, reason(number));
}

}  // namespace

FileIdentity identity_of(const struct stat& status) {
  return {.device = status.st_dev,
          .inode = status.st_ino,
          .bytes = static_cast<std::uint64_t>(std::max<off_t>(status.st_size, 0)),
          .modified = nanoseconds(status.st_mtim),
          .changed = nanoseconds(status.st_ctim)};
}

FileIdentity identify(const std::string& path) {
  struct stat status{};
  return ::stat(path.c_str(), &status) == 0 ? identity_of(status) : FileIdentity{};
}

std::shared_ptr<const ImageFile> ImageFile::open(const std::string& path, const ImageLimits& limits,
                                                 Diagnostic& error) {
  const auto fail = [&](std::string code, std::string message) {
    error = image_error(std::move(code), path, std::move(message));
    return nullptr;
  };
  // Looked at before it is opened, for opening a device may do something, and afterwards,
  // for it may be another by then.
  struct stat status{};
  if (::stat(path.c_str(), &status) != 0) {
    error = cannot_open(path, errno);
    return nullptr;
  }
  if (!S_ISREG(status.st_mode)) return fail("unreadable-image", "the image is not a regular file");
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (descriptor < 0) {
    error = cannot_open(path, errno);
    return nullptr;
  }
  const std::shared_ptr<ImageFile> file(new ImageFile(path, descriptor));
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) {
    return fail("unreadable-image", "the image is not a regular file");
  }
  file->identity_ = identity_of(status);
  if (file->bytes() > limits.max_file_bytes) {
    error = image_error("image-too-large", path, "the file is too large",
                        fmt::format("at most {} bytes", limits.max_file_bytes),
                        fmt::format("{}", file->bytes()));
    return nullptr;
  }
  std::array<char, image_signature_bytes> bytes{};
  const std::size_t count = file->read(0, bytes.data(), bytes.size());
  if (count == 0) return fail("unreadable-image", "the image is empty");
  std::array<unsigned char, image_signature_bytes> first{};
  std::copy(bytes.begin(), bytes.end(), first.begin());
  const auto format = recognise_image(std::span(first).first(count));
  if (!format) {
    error = image_error("unsupported-image", path, "the image is of no supported format",
                        "exr, png, jpeg, tiff, tx, hdr, bmp, gif or tga without palette",
                        fmt::format("a file beginning with bytes {:02x} {:02x} {:02x} {:02x}",
                                    first[0], first[1], first[2], first[3]));
    return nullptr;
  }
  file->format_ = *format;
  return file;
}

ImageFile::~ImageFile() { ::close(descriptor_); }

std::size_t ImageFile::read(std::uint64_t at, char* to, std::size_t count) const {
  std::size_t done = 0;
  while (done < count) {
    const ssize_t got =
        ::pread(descriptor_, to + done, count - done, static_cast<off_t>(at + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

bool FileCursor::take(std::uint64_t count, std::string& bytes) {
  constexpr std::size_t ahead = 1 << 16;
  if (count > left()) return false;
  bytes.resize(static_cast<std::size_t>(count));
  if (count > ahead) {
    if (file_.read(at_, bytes.data(), bytes.size()) != bytes.size()) return false;
  } else if (count > 0) {
    if (at_ < buffer_at_ || at_ + count > buffer_at_ + buffer_.size()) {
      buffer_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(ahead, left())));
      buffer_.resize(file_.read(at_, buffer_.data(), buffer_.size()));
      buffer_at_ = at_;
      if (buffer_.size() < count) return false;
    }
    buffer_.copy(bytes.data(), bytes.size(), static_cast<std::size_t>(at_ - buffer_at_));
  }
  at_ += count;
  return true;
}

}  // namespace nacre
