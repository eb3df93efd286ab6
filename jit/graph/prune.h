#pragma once

#include "jit/graph/graph.h"

namespace nacre {

/// Drops nodes and parameters that no output depends on and renumbers the rest,
/// keeping their order.
void prune(Graph& graph);

}  // namespace nacre
