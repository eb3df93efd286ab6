#pragma once

#include <memory>

#include "runtime/kernel.h"

namespace nacre {

/// A kernel that runs `program` operation by operation over blocks of points:
/// ready at once, needs no executable memory, and gives the bits that compiled
/// code gives. Transcendental operations and marks must have been expanded.
std::unique_ptr<Kernel> make_interpreter(Program program);

}  // namespace nacre
