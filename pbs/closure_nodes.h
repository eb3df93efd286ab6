#pragma once

#include <vector>

#include "runtime/node/node_call.h"

namespace nacre {

/// The native bodies of nodes whose output is a BSDF, an EDF, a VDF or a shader,
/// sorted by folder and category; pbs/nodes.txt is the list.
const std::vector<NodeBody>& closure_nodes();

}  // namespace nacre
