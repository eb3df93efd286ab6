#include "nodes/math/safe.h"
#include "runtime/node/componentwise.h"

namespace nacre {

/// in1^in2, componentwise. MaterialX 1.39 Standard Nodes, "power". Defined
/// everywhere as in Open Shading Language: 1 for an exponent of 0, else 0 for a
/// base of 0 and for a negative base with a fractional exponent; never infinite.
void record_power(NodeCall& call) {
  componentwise(call, ports("in1", "in2"), [](Float a, Float b) { return safe_power(a, b); });
}

}  // namespace nacre
