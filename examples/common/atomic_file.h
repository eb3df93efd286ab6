#pragma once

#include <functional>
#include <string>

#include "runtime/diagnostic.h"

namespace nacre::host {

/// Has `write` fill a temporary file beside `path`, then gives it that name: a
/// file appears complete or not at all. `write` gets the temporary's name, which
/// keeps the extension, and returns what went wrong, or "". False with an error
/// if anything did; the temporary is gone then.
bool write_atomically(const std::string& path,
                      const std::function<std::string(const std::string&)>& write,
                      Diagnostics& diagnostics);

}  // namespace nacre::host
