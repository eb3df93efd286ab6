#pragma once

#include "jit/document/nodedef.h"
#include "jit/graph/graph.h"

namespace nacre {

/// The implementation by text of a nodedef that an <implementation> element
/// gives: see Definitions::source_of.
NodeSource node_source(const NodeDef& def, const Element& implementation);

}  // namespace nacre
