#pragma once

#include "examples/render/render.h"
#include "runtime/diagnostic.h"

namespace CLI {
class App;
}

namespace nacre::tool {

/// --crop of `nacre render`; it writes to `settings`, which lives as long as `command`.
void add_crop(CLI::App& command, host::RenderSettings& settings);

/// An error for a crop that has pixels which the picture, of a size that is known by now, has not.
void check_crop(const host::RenderSettings& settings, Diagnostics& diagnostics);

/// Says of a file that has no place for it that where the crop lies is not in it.
void report_crop(const host::RenderSettings& settings, const std::string& file,
                 Diagnostics& diagnostics);

}  // namespace nacre::tool
