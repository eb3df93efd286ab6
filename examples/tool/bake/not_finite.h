#pragma once

#include "examples/bake/texel_statistics.h"
#include "runtime/diagnostic.h"

namespace nacre::tool {

/// A warning where numbers of a map are infinite or NaN: who reads it gets light of that kind.
void report_not_finite(const host::TexelStatistics& map, const SourceLocation& where,
                       Diagnostics& diagnostics);

}  // namespace nacre::tool
