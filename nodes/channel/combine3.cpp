#include "nodes/channel/combine.h"

namespace nacre {

/// Three floats as one colour or vector. MaterialX 1.39 Standard Nodes, "combine3".
/// Components pass as they are, infinities and NaN too.
void record_combine3(NodeCall& call) { record_combine(call); }

}  // namespace nacre
