#pragma once

#include <nlohmann/json_fwd.hpp>

#include "examples/render/render.h"
#include "examples/tool/render_options.h"

namespace nacre::tool {

/// What `nacre render --json` says of a picture that is not written.
nlohmann::ordered_json unwritten_picture(const RenderOptions& options);

/// The same of one that is: its size, passes and samples, and what they took.
nlohmann::ordered_json written_picture(const RenderOptions& options,
                                       const host::RenderStatistics& statistics);

}  // namespace nacre::tool
