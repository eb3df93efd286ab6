#pragma once

#include "runtime/program/program.h"

namespace nacre {

/// The same computation for points of no extent: every Op::ddx is 0, and what is needed for
/// derivatives alone is gone, channels included.
Program drop_footprints(const Program& program);

}  // namespace nacre
