#include "nodes/math/rounding.h"

namespace nacre {

namespace {

Float round_half_away(Float x) {
  const Float whole = trunc(x);
  const Float step = select(abs(x - whole) >= 0.5f, select(x < 0.0f, Float(-1.0f), 1.0f), 0.0f);
  return whole + step;
}

}  // namespace

/// The nearest integer, halves away from zero. MaterialX 1.39 Standard Nodes,
/// "round", which leaves halves open: C's and Open Shading Language's rule. The
/// integer overload clamps to the range of int and gives 0 for NaN.
void record_round(NodeCall& call) { record_rounding(call, round_half_away); }

}  // namespace nacre
