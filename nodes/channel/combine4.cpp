#include "nodes/channel/combine.h"

namespace nacre {

/// Four floats as one colour or vector. MaterialX 1.39 Standard Nodes, "combine4".
/// Components pass as they are, infinities and NaN too.
void record_combine4(NodeCall& call) { record_combine(call); }

}  // namespace nacre
