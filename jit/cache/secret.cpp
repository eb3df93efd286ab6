#include "jit/cache/secret.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "jit/cache/folder.h"

namespace nacre {

namespace {

constexpr std::size_t secret_bytes = 32;

std::optional<std::string> read_secret(int folder, std::string& fault) {
  struct stat status{};
  if (fstatat(folder, secret_name, &status, AT_SYMLINK_NOFOLLOW) != 0) return std::nullopt;
  auto bytes = read_trusted(folder, secret_name, secret_bytes, fault);
  if (bytes && bytes->size() != secret_bytes) fault = "is damaged";
  if (bytes && (status.st_mode & (S_IRGRP | S_IROTH)) != 0) fault = "can be read by others";
  if (!bytes && fault.empty()) fault = "can't be read";
  return fault.empty() ? bytes : std::nullopt;
}

/// A link appears whole or, where there is one already, not at all.
void make_secret(int folder, std::string& fault) {
  std::string bytes(secret_bytes, '\0');
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    fault = "can't be made";
    return;
  }
  const std::string temporary = fmt::format("{}{}-secret-{}", temporary_prefix, getpid(),
                                            reinterpret_cast<std::uintptr_t>(&bytes));
  unlinkat(folder, temporary.c_str(), 0);
  const bool done =
      write_new(folder, temporary, bytes) &&
      (linkat(folder, temporary.c_str(), folder, secret_name, 0) == 0 || errno == EEXIST);
  if (!done) fault = "can't be made: " + std::generic_category().message(errno);
  unlinkat(folder, temporary.c_str(), 0);
}

}  // namespace

std::optional<std::string> folder_secret(int folder, std::string& fault) {
  std::optional<std::string> secret = read_secret(folder, fault);
  if (secret || !fault.empty()) return secret;
  make_secret(folder, fault);
  if (!fault.empty()) return std::nullopt;
  secret = read_secret(folder, fault);
  if (!secret && fault.empty()) fault = "is gone";
  return secret;
}

}  // namespace nacre
