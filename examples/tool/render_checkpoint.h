#pragma once

#include <optional>
#include <string>

#include "examples/render/checkpoint.h"
#include "examples/tool/options.h"
#include "examples/tool/render_options.h"

namespace nacre::tool {

/// What was given of a command's options, those left out that no bit of a picture hangs on.
std::string asked_of(const CLI::App& command);

/// Where the render is kept; its key is everything that a picture hangs on: what was asked for and
/// the files, but for images.
std::optional<host::Checkpoint> checkpoint_of(const RenderOptions& options, const Opened& opened);

}  // namespace nacre::tool
