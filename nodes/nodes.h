#pragma once

#include <vector>

#include "runtime/node/node_call.h"

namespace nacre {

/// The native bodies of the standard library, sorted by folder and category;
/// nodes/nodes.txt is the list. Categories that closures share with numbers
/// (mix, add, multiply) have their closure body in pbs/closure_nodes.h.
const std::vector<NodeBody>& standard_nodes();

}  // namespace nacre
