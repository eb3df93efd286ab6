#pragma once

#include <vector>

#include "runtime/program/program.h"

namespace nacre::codegen {

/// What the entry computes once for all batches, by value id: instructions
/// outside every region that are uniform and need only such ones, and regions
/// in which all are.
std::vector<bool> hoistable(const Function& entry);

}  // namespace nacre::codegen
