#include "nodes/channel/combine.h"

namespace nacre {

/// Two values as one colour or vector. MaterialX 1.39 Standard Nodes, "combine2".
/// Components pass as they are, infinities and NaN too.
void record_combine2(NodeCall& call) { record_combine(call); }

}  // namespace nacre
