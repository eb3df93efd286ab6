#pragma once

#include <filesystem>
#include <string>

namespace nacre::tool {

/// Without "..", as far as the working folder can be had.
std::filesystem::path absolute_path(const std::filesystem::path& path);

/// How a path reads from a folder, with '/'; as it is where it does not.
std::string from_folder(const std::filesystem::path& path, const std::filesystem::path& folder);

}  // namespace nacre::tool
