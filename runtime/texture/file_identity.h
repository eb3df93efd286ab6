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
  std::uint64_t device = 0;   ///< Of the file system.
  std::uint64_t inode = 0;    ///< Of the file on it.
  std::uint64_t bytes = 0;    ///< Its size.
  std::int64_t modified = 0;  ///< Nanoseconds since 1970.
  std::int64_t changed = 0;   ///< The same, of contents or properties; nobody can set it.

  auto operator<=>(const FileIdentity&) const = default;
};

/// From what the system says of an open file or a path.
FileIdentity identity_of(const struct stat& status);

/// All zero where there is no such file.
FileIdentity identify(const std::string& path);

}  // namespace nacre
