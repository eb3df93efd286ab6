#include "jit/cache/kernel_cache.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "jit/cache/entry_file.h"
#include "jit/cache/folder.h"
#include "jit/cache/secret.h"
#include "runtime/digest.h"

namespace nacre {

namespace {

void report(Diagnostics& diagnostics, const std::string& path, const std::string& message) {
  SourceLocation where;
  where.file = path;
  diagnostics.warning("kernel-cache", std::move(where), message);
}

/// Without slashes and dots at the end, behind which a link would be followed.
std::filesystem::path without_trailing(std::filesystem::path folder) {
  while (folder.has_relative_path() && (!folder.has_filename() || folder.filename() == ".") &&
         folder.has_parent_path()) {
    folder = folder.parent_path();
  }
  return folder;
}

/// A file larger than this is not one of ours; it won't be read into memory.
constexpr std::uint64_t largest_file = 1ull << 28;

}  // namespace

std::unique_ptr<KernelCache> KernelCache::open(const std::filesystem::path& asked,
                                               Diagnostics& diagnostics, std::uint64_t limit) {
  const std::filesystem::path folder = without_trailing(asked);
  std::error_code ignored;
  const auto parent = std::filesystem::absolute(folder, ignored).parent_path();
  std::filesystem::create_directories(parent, ignored);
  mkdir(folder.c_str(), S_IRWXU);
  Descriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  std::string fault =
      opened ? distrust(opened.get(), true)
             : std::string("can't be opened: ") + std::generic_category().message(errno);
  if (!fault.empty()) {
    report(diagnostics, folder.string(), "kernels are not cached, because the folder " + fault);
    return nullptr;
  }
  std::optional<std::string> secret = folder_secret(opened.get(), fault);
  if (!secret) {
    report(diagnostics, (folder / secret_name).string(),
           "kernels are not cached, because the file that signs them " + fault);
    return nullptr;
  }
  return std::unique_ptr<KernelCache>(new KernelCache(opened.release(), std::move(*secret), limit));
}

KernelCache::~KernelCache() { close(folder_); }

std::unique_ptr<KernelCache> KernelCache::reopened() const {
  const int copy = fcntl(folder_, F_DUPFD_CLOEXEC, 0);
  if (copy < 0) return nullptr;
  return std::unique_ptr<KernelCache>(new KernelCache(copy, secret_, limit_));
}

std::string KernelCache::file_name(const std::string& key) {
  return to_hex(sha256(key)) + std::string(kernel_suffix);
}

std::optional<ObjectCode> KernelCache::load(const std::string& key, const std::string& interface,
                                            Diagnostics& diagnostics) {
  const std::string name = file_name(key);
  std::string fault;
  const std::optional<std::string> bytes = read_trusted(folder_, name, largest_file, fault);
  if (!bytes) {
    if (!fault.empty())
      warn(diagnostics, "a cached kernel was not used, because it " + fault, name);
    return std::nullopt;
  }
  std::optional<ObjectCode> object = unpack(*bytes, key, secret_);
  if (object && object->interface == interface) return object;
  warn(diagnostics,
       object ? "a cached kernel was not used, because it is bound to other channels"
              : "a cached kernel was not used, because it is damaged or was made by somebody else",
       name);
  unlinkat(folder_, name.c_str(), 0);
  return std::nullopt;
}

void KernelCache::store(const std::string& key, const ObjectCode& object,
                        Diagnostics& diagnostics) {
  if (read_only_) return;
  const std::string file = pack(key, object, secret_);
  const std::string name = file_name(key);
  const std::string temporary = fmt::format("{}{}-{}-{}", temporary_prefix, getpid(),
                                            reinterpret_cast<std::uintptr_t>(this), number_++);
  if (!write_and_rename(folder_, name, temporary, file)) {
    const int error = errno;
    read_only_ = true;
    warn(diagnostics, "can't store a kernel: " + std::generic_category().message(error), name);
    return;
  }
  grow(file.size());
}

void KernelCache::warn(Diagnostics& diagnostics, const std::string& message,
                       const std::string& file) {
  if (!warned_.exchange(true)) report(diagnostics, file, message);
}

void KernelCache::grow(std::uint64_t bytes) {
  const std::scoped_lock lock(mutex_);
  if (total_) *total_ += bytes;
  // Down to nine tenths, so that not every store after it sweeps again.
  if (!total_) {
    total_ = sweep(folder_, limit_);
  } else if (*total_ > limit_) {
    total_ = sweep(folder_, limit_ / 10 * 9);
  }
}

std::filesystem::path default_cache_folder() {
  const auto absolute = [](const char* name) {
    const char* text = std::getenv(name);
    const std::filesystem::path path(text == nullptr ? "" : text);
    return path.is_absolute() ? path : std::filesystem::path();
  };
  if (const auto base = absolute("XDG_CACHE_HOME"); !base.empty()) return base / "nacre";
  if (const auto home = absolute("HOME"); !home.empty()) return home / ".cache" / "nacre";
  return {};
}

}  // namespace nacre
