#include "runtime/node/componentwise.h"

namespace nacre {

/// in - floor(in), kept below 1 where that rounds up to it (tiny negative
/// values). MaterialX 1.39 Standard Nodes, "fract". NaN for infinities.
void record_fract(NodeCall& call) {
  componentwise(call, ports("in"), [](Float x) { return min(0x1.fffffep-1f, x - floor(x)); });
}

}  // namespace nacre
