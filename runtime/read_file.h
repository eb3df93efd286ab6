#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "runtime/diagnostic.h"

namespace nacre {

/// All of a regular file of at most so many bytes. Nothing, said ("cannot-read" or
/// "file-too-large"), where it cannot be had; a pipe is refused and does not hang.
std::optional<std::string> read_file(const std::string& path, std::uint64_t most_bytes,
                                     Diagnostics& diagnostics);

}  // namespace nacre
