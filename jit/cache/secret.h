#pragma once

#include <optional>
#include <string>

namespace nacre {

/// The name of the file with the secret, in the folder that it signs the files of.
inline constexpr const char* secret_name = ".secret";

/// 32 random bytes that only the user knows and that stay the same as long as the folder
/// does: read, or made and stored (mode 0600) where there are none. Processes that come
/// first together agree. Nothing, with the reason in `fault`, if they can't be had or others
/// may know them.
std::optional<std::string> folder_secret(int folder, std::string& fault);

}  // namespace nacre
