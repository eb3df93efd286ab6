#include "runtime/node/componentwise.h"

namespace nacre {

/// -1, 0 or 1. MaterialX 1.39 Standard Nodes, "sign". 0 for NaN.
void record_sign(NodeCall& call) {
  componentwise(call, ports("in"), [](Float x) {
    return select(x > 0.0f, 1.0f, select(x < 0.0f, Float(-1.0f), 0.0f));
  });
}

}  // namespace nacre
