#pragma once

#include "tests/pbs/battery/closure_kernels.h"

namespace nacre {

/// So many points, each hostile in its own way (see Hostility): the inputs of a closure, the
/// geometry of the point, wo, wi and u, and what slots a host fills. The same for the same seed.
/// Half of the frames are z, x, y; of the wi some are mirrored, straight on or back.
Arrays hostile_points(const std::vector<ClosureInput>& inputs, std::uint64_t seed,
                      std::size_t count);

/// All that a point was given, one line a channel, floats in a form that comes back equal.
std::string describe_point(const Arrays& points, std::size_t index);

}  // namespace nacre
