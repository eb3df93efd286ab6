#pragma once

#include <cstdint>
#include <memory>

#include "runtime/kernel.h"
#include "runtime/program/cost.h"

namespace nacre {

/// A kernel that runs `program` operation by operation over blocks of points:
/// ready at once, needs no executable memory, and gives the bits that compiled
/// code gives. Transcendental operations and marks must have been expanded.
std::unique_ptr<Kernel> make_interpreter(Program program,
                                         std::uint64_t max_steps = default_max_steps);

}  // namespace nacre
