#pragma once

#include <compare>
#include <cstdint>
#include <string>

struct stat;

namespace nacre {

/// Which file a path led to, and in which state: it differs when the file was replaced or
/// written, even within a second and with as many bytes. (Not when it was written twice in
/// one tick of the file system's clock, a few milliseconds, in place and with as many bytes.)
struct FileIdentity {
  std::uint64_t device = 0;
  std::uint64_t inode = 0;
  std::uint64_t bytes = 0;
  std::int64_t modified = 0;  ///< Nanoseconds since 1970; so `changed`, which nobody can set.
  std::int64_t changed = 0;

  auto operator<=>(const FileIdentity&) const = default;
};

FileIdentity identity_of(const struct stat& status);

/// All zero where there is no such file.
FileIdentity identify(const std::string& path);

}  // namespace nacre
