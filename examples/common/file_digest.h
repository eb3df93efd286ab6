#pragma once

#include <optional>
#include <string>

#include "runtime/digest.h"
#include "runtime/texture/file_identity.h"

namespace nacre::host {

/// SHA-256 of all that is in a regular file; nothing where it cannot be read, or was written
/// meanwhile. `identity`: what the file was, unless null.
std::optional<Digest> digest_of_file(const std::string& path, FileIdentity* identity = nullptr);

}  // namespace nacre::host
