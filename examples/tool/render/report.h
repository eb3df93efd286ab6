#pragma once

#include "examples/render/render.h"
#include "runtime/diagnostic.h"

namespace nacre::tool {

/// Warnings of what a picture lacks: results that were no numbers, and light in media.
void report_left_out(const host::RenderStatistics& statistics, Diagnostics& diagnostics);

}  // namespace nacre::tool
