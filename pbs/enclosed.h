#pragma once

#include <vector>

#include "pbs/term.h"
#include "pbs/view.h"
#include "runtime/program/slice.h"

namespace nacre {

/// What the kernels `interior` and `subsurface` store; see SurfaceKernels. None where light cannot
/// enter.
/// @{
std::vector<SliceOutput> interior_channels(const View& view, const std::vector<Term>& terms,
                                           const std::vector<SeenMedium>& media);
std::vector<SliceOutput> subsurface_channels(const View& view, const std::vector<Term>& terms);
/// @}

}  // namespace nacre
