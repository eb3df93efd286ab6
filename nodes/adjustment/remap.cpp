#include "nodes/math/safe.h"
#include "runtime/node/componentwise.h"

namespace nacre {

/// in moved linearly from [inlow, inhigh] to [outlow, outhigh], componentwise and
/// not clamped. MaterialX 1.39 Standard Nodes, "remap". outlow where the range is
/// empty, as in Open Shading Language. So also where `in` is infinite or NaN.
void record_remap(NodeCall& call) {
  componentwise(call, ports("in", "inlow", "inhigh", "outlow", "outhigh"),
                [](Float x, Float inlow, Float inhigh, Float outlow, Float outhigh) {
                  const Float t = safe_divide(x - inlow, inhigh - inlow);
                  return fma(outhigh - outlow, t, outlow);
                });
}

}  // namespace nacre
