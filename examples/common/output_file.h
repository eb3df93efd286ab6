#pragma once

#include <string>

#include "runtime/diagnostic.h"

namespace nacre::host {

/// Makes the folder of a file that is going to be written, where there is none, and sees
/// that files can be made there, so that nobody works for what cannot be kept. False, with
/// an error, if they cannot, or if `path` is something other than a file.
bool prepare_output_file(const std::string& path, Diagnostics& diagnostics);

}  // namespace nacre::host
