#pragma once

#include <filesystem>
#include <string>

#include "jit/ocio/ocio_module.h"
#include "runtime/diagnostic.h"

namespace nacre {

/// What reads the file config.ocio; null, with a diagnostic, where there is no such file or no
/// OpenColorIO.
const OcioModule* open_ocio(const std::filesystem::path& path, Diagnostics& diagnostics);

/// The error bad-color-config.
void report_bad_config(const std::filesystem::path& path, std::string found,
                       Diagnostics& diagnostics);

}  // namespace nacre
