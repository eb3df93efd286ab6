#include "runtime/node/componentwise.h"

namespace nacre {

/// in limited to [low, high], componentwise. MaterialX 1.39 Standard Nodes,
/// "clamp". Where low > high the result is low, as in Open Shading Language; NaN
/// gives high.
void record_clamp(NodeCall& call) {
  componentwise(call, ports("in", "low", "high"),
                [](Float x, Float low, Float high) { return max(min(x, high), low); });
}

}  // namespace nacre
