#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "runtime/diagnostic.h"

namespace nacre::host {

/// The bytes of a regular file. Nothing, with an error at `where`, if there is none (so
/// that nobody waits for a pipe), if it cannot be read, or if it is longer than `budget`,
/// from which what was read is taken.
std::optional<std::string> read_scene_file(const std::string& path, const SourceLocation& where,
                                           std::size_t& budget, Diagnostics& diagnostics);

}  // namespace nacre::host
