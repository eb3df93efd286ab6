#pragma once

#include <optional>
#include <string>
#include <vector>

#include "examples/render/render.h"
#include "examples/tool/options.h"
#include "examples/tool/render/options.h"

namespace nacre::tool {

/// What was given of a command's options, those left out that no bit of a picture hangs on.
std::string asked_of(const CLI::App& command);

/// Everything that a picture hangs on, as text: what was asked for, the document and all that it
/// reads, the scene as it stands with the camera, the time and frame, and the images of the
/// kernels. Nothing, with an error, where a file cannot be read again or was written meanwhile.
std::optional<std::string> render_key(const RenderOptions& options, const Opened& opened,
                                      const host::RenderInput& input,
                                      const host::RenderSettings& settings,
                                      const std::vector<const BoundKernel*>& kernels,
                                      Diagnostics& diagnostics);

}  // namespace nacre::tool
