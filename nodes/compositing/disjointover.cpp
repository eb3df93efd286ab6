#include "nodes/compositing/blend.h"

namespace nacre {

namespace {

Color4 disjoint_over(Color4 fg, Color4 bg) {
  const Float alpha = fg.w + bg.w;
  const Bool fits = alpha <= 1.0f;
  const Bool empty = (!fits) & (abs(bg.w) < 1e-8f);
  const Float share = select(fits, 1.0f, (1.0f - fg.w) / bg.w);
  const Color4 sum = add_scaled(fg, share, bg);
  return {select(empty, 0.0f, sum.x), select(empty, 0.0f, sum.y), select(empty, 0.0f, sum.z),
          min(alpha, 1.0f)};
}

}  // namespace

/// F + B where f + b <= 1, else F + B (1 - f) / b; alpha min(f + b, 1); blended over
/// bg by mix. Lower-case letters are the alphas. MaterialX 1.39 Standard Nodes,
/// "disjointover". Black where f + b > 1 and |b| is below 1e-8, as the
/// specification's generators do. A sum f + b of NaN counts as above 1. Else edges
/// as in blend.h.
void record_disjointover(NodeCall& call) { record_alpha_operator(call, disjoint_over); }

}  // namespace nacre
