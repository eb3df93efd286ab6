#pragma once

#include <string>

namespace nacre {

/// A file that is there and whose path differs from `path` in upper and lower case only;
/// "" if there is none. For a hint: who wrote the name has a file system that does not care.
std::string find_other_case(const std::string& path);

}  // namespace nacre
