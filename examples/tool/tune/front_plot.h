#pragma once

#include <string>
#include <vector>

#include "jit/tune/profile.h"

namespace nacre::tool {

/// A picture, SVG, of what speed is traded for: a line a subject from its most exact kernels to its
/// cheapest, error over nanoseconds a point (or what is counted for them, where nothing was timed),
/// both axes logarithmic; a disc on what was chosen, a ring on what is compiled where nothing is
/// said.
std::string front_plot(const std::vector<TunedSubject>& subjects, double max_error);

}  // namespace nacre::tool
