#pragma once

#include <cstddef>

#include "jit/passes/range.h"
#include "runtime/program/program.h"

namespace nacre {

/// Leaves out what cannot happen where so much is known of what a Program reads: numbers that are
/// known become literals; comparisons whose outcome is certain go, and what hangs on them, clamps
/// that change nothing, regions that no lane enters. Every result keeps its bits, signs of
/// zeros too. For Programs without transcendental functions, which engines round as they like.
/// Stops as transform() does beyond `most` instructions.
Program decide(const Program& program, const Known& known, std::size_t most);

}  // namespace nacre
