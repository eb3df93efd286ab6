#pragma once

#include "runtime/node/componentwise.h"

namespace nacre {

// Edges that the nodes of this folder share: sums and products are IEEE's, as
// nodes/math/safe.h says. Nothing is limited to [0, 1]: a mix or an alpha beyond it
// extrapolates. An infinity makes NaN where its weight is 0; NaN passes, at any weight.

/// (1 - mix) bg + mix x, and just one of them where mix is a literal 0 or 1 (an
/// infinity in the other can't reach the result then).
inline Float blend(Float bg, Float x, Float mix) {
  if (mix.is_constant(0.0f)) return bg;
  if (mix.is_constant(1.0f)) return x;
  return lerp(bg, x, mix);
}

/// Sets the operator op(fg, bg) -> Color4 of a node with inputs fg, bg and mix,
/// blended over bg by mix.
template <class F>
void record_alpha_operator(NodeCall& call, F&& op) {
  const Color4 fg = call.vector4("fg");
  const Color4 bg = call.vector4("bg");
  const Float mix = call.number("mix");
  const Color4 x = op(fg, bg);
  call.set(Color4{blend(bg.x, x.x, mix), blend(bg.y, x.y, mix), blend(bg.z, x.z, mix),
                  blend(bg.w, x.w, mix)});
}

/// s c, alpha too.
inline Color4 scaled(Float s, Color4 c) { return {s * c.x, s * c.y, s * c.z, s * c.w}; }

/// a + s b, alpha too.
inline Color4 add_scaled(Color4 a, Float s, Color4 b) {
  return {fma(s, b.x, a.x), fma(s, b.y, a.y), fma(s, b.z, a.z), fma(s, b.w, a.w)};
}

}  // namespace nacre
