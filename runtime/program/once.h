#pragma once

#include <vector>

#include "runtime/program/program.h"

namespace nacre {

/// What the entry computes once for all batches of a call, by value id: instructions outside
/// every region that are uniform and need only such ones, and regions in which all are.
std::vector<bool> once_per_call(const Function& entry);

/// The same with what regions compute of such values alone and nobody can tell whether it was: what
/// an engine may take out of them. Not what was fitted, which may not be there.
std::vector<bool> once_out_of_regions(const Function& entry);

}  // namespace nacre
