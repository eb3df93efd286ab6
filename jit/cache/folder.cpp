#include "jit/cache/folder.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <utility>
#include <vector>

namespace nacre {

namespace {

/// A file of the cache, for choosing what goes.
struct Entry {
  std::string name;
  timespec used;
  std::uint64_t bytes;
};

/// Seconds after which a temporary file belongs to nobody any more.
constexpr std::time_t abandoned = 3600;

std::vector<Entry> list(int folder) {
  std::vector<Entry> entries;
  // fdopendir takes the descriptor over, and its position is shared: open anew.
  const int copy = openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  DIR* stream = copy < 0 ? nullptr : fdopendir(copy);
  if (stream == nullptr) {
    if (copy >= 0) close(copy);
    return entries;
  }
  while (const dirent* item = readdir(stream)) {
    struct stat status{};
    if (fstatat(folder, item->d_name, &status, AT_SYMLINK_NOFOLLOW) != 0) continue;
    if (!S_ISREG(status.st_mode)) continue;
    const std::string_view name = item->d_name;
    if (!name.starts_with(temporary_prefix) && !name.ends_with(kernel_suffix)) continue;
    entries.push_back({item->d_name, status.st_mtim, static_cast<std::uint64_t>(status.st_size)});
  }
  closedir(stream);
  return entries;
}

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

/// False where that cannot be: see write_and_rename.
bool write_nameless(int folder, const std::string& name, std::string_view bytes) {
  const Descriptor file(openat(folder, ".", O_WRONLY | O_TMPFILE | O_CLOEXEC, S_IRUSR | S_IWUSR));
  if (!file || !write_all(file.get(), bytes)) return false;
  const std::string here = "/proc/self/fd/" + std::to_string(file.get());
  return linkat(AT_FDCWD, here.c_str(), folder, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
}

}  // namespace

Descriptor::~Descriptor() {
  if (number_ >= 0) close(number_);
}

int Descriptor::release() { return std::exchange(number_, -1); }

std::string distrust(int descriptor, bool folder) {
  struct stat status{};
  if (fstat(descriptor, &status) != 0) return "can't be examined";
  if (folder ? !S_ISDIR(status.st_mode) : !S_ISREG(status.st_mode)) {
    return folder ? "is no folder" : "is no regular file";
  }
  if (status.st_uid != geteuid()) return "belongs to somebody else";
  if ((status.st_mode & (S_IWGRP | S_IWOTH)) != 0) return "can be written by others";
  return {};
}

std::optional<std::string> read_trusted(int folder, const std::string& name, std::uint64_t largest,
                                        std::string& fault) {
  // Without O_NONBLOCK a pipe of that name would block us.
  const Descriptor file(
      openat(folder, name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (!file) {
    if (errno == ELOOP) fault = "is a link";
    if (errno == EACCES) fault = "can't be read";
    return std::nullopt;
  }
  fault = distrust(file.get(), false);
  if (!fault.empty()) return std::nullopt;
  struct stat status{};
  if (fstat(file.get(), &status) == 0 && static_cast<std::uint64_t>(status.st_size) > largest) {
    fault = "is too large";
    return std::nullopt;
  }
  std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    const ssize_t got = read(file.get(), bytes.data() + filled, bytes.size() - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    filled += static_cast<std::size_t>(got);
  }
  bytes.resize(filled);
  futimens(file.get(), nullptr);
  return bytes;
}

bool write_new(int folder, const std::string& name, std::string_view bytes) {
  const Descriptor file(openat(folder, name.c_str(),
                               O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC,
                               S_IRUSR | S_IWUSR));
  if (!file) return false;
  if (write_all(file.get(), bytes)) return true;
  const int reason = errno;
  unlinkat(folder, name.c_str(), 0);
  errno = reason;
  return false;
}

bool write_and_rename(int folder, const std::string& name, const std::string& temporary,
                      std::string_view bytes) {
  if (write_nameless(folder, name, bytes)) return true;
  if (!write_new(folder, temporary, bytes)) return false;
  if (renameat(folder, temporary.c_str(), folder, name.c_str()) == 0) return true;
  const int reason = errno;
  unlinkat(folder, temporary.c_str(), 0);
  errno = reason;
  return false;
}

std::uint64_t sweep(int folder, std::uint64_t limit) {
  std::vector<Entry> entries = list(folder);
  std::ranges::sort(entries, [](const Entry& a, const Entry& b) {
    return std::pair(a.used.tv_sec, a.used.tv_nsec) < std::pair(b.used.tv_sec, b.used.tv_nsec);
  });
  std::uint64_t total = 0;
  for (const Entry& entry : entries) total += entry.bytes;
  const std::time_t now = std::time(nullptr);
  for (const Entry& entry : entries) {
    const bool temporary = entry.name.starts_with(temporary_prefix);
    const bool stale = temporary && now - entry.used.tv_sec > abandoned;
    if (!stale && (temporary || total <= limit)) continue;
    if (unlinkat(folder, entry.name.c_str(), 0) == 0) total -= entry.bytes;
  }
  return total;
}

}  // namespace nacre
