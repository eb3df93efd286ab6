#include "nodes/math/safe.h"
#include "runtime/node/componentwise.h"

namespace nacre {

namespace {

/// The fma makes the remainder exact for the quotient that was rounded to an
/// integer; where that rounding went up, the remainder has the wrong sign and
/// one divisor brings it back. What still isn't below |b| is 0 modulo b.
Float modulo(Float a, Float b) {
  const Float remainder = fma(-floor(safe_divide(a, b)), b, a);
  const Bool wrong_side = ((remainder < 0.0f) & (b > 0.0f)) | ((remainder > 0.0f) & (b < 0.0f));
  const Float wrapped = select(wrong_side, remainder + b, remainder);
  return select((abs(wrapped) >= abs(b)) & (b != 0.0f), 0.0f, wrapped);
}

}  // namespace

/// in1 - in2 floor(in1 / in2), componentwise: in [0, in2), or (in2, 0] for a
/// negative in2. MaterialX 1.39 Standard Nodes, "modulo", which asks for
/// in2 != 0; in1 for in2 = 0, as in Open Shading Language. NaN for infinities.
void record_modulo(NodeCall& call) { componentwise(call, ports("in1", "in2"), modulo); }

}  // namespace nacre
