#pragma once

#include "runtime/program/program.h"

namespace nacre {

/// What a point costs, as a number that is the same on every machine: operations as engines run
/// them, each by how much longer it takes than an addition; every region entered, every loop one
/// round. For comparing Programs of one document with each other.
double estimated_cost(const Program& program);

}  // namespace nacre
