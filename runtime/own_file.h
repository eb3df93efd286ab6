#pragma once

#include <filesystem>
#include <vector>

namespace nacre {

/// A file that comes with the library.
struct OwnFile {
  std::filesystem::path installed;  ///< Below the prefix: "libexec/nacre/nacre-compile-worker".
  std::filesystem::path built;      ///< Below the folder of the build, or a path from the root.
};

/// Where such a file may be, the best place first, from where the library lies (or the program
/// that has it inside): below the prefix of a `bin`, `lib` or `lib/x86_64-linux-gnu`, wherever
/// that was moved to. What lies in the folder of a build, and nothing else, looks there too.
std::vector<std::filesystem::path> places_of(const OwnFile& file);

/// The first of them where there is a file; empty if there is none.
std::filesystem::path find_own_file(const OwnFile& file);

}  // namespace nacre
