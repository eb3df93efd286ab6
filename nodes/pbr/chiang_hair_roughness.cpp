#include "runtime/node/node_call.h"

namespace nacre {

namespace {

/// x^4, so that the high powers below are a few exact-enough products.
Float fourth(Float x) { return square(square(x)); }

}  // namespace

/// Longitudinal variance v and azimuthal scale s of the R, TT and TRT lobes of hair
/// from perceptual roughnesses: the fits of Chiang et al., "A Practical and
/// Controllable Hair and Fur Model for Production Path Tracing", 2016, with v scaled
/// by the squares of scale_TT and scale_TRT. MaterialX 1.39 Physically Based Shading
/// Nodes, "chiang_hair_roughness". The roughnesses are limited to [0.001, 1]. NaN
/// counts as 0.001. The scales are not limited.
void record_chiang_hair_roughness(NodeCall& call) {
  const Float l = clamp(call.number("longitudinal"), 0.001f, 1.0f);
  const Float a = clamp(call.number("azimuthal"), 0.001f, 1.0f);
  const Float l20 = fourth(l) * fourth(fourth(l));
  const Float a22 = square(a) * fourth(a) * fourth(fourth(a));
  const Float v = square(fma(3.7f, l20, l * fma(0.812f, l, 0.726f)));
  const Float s = fma(5.372f, a22, a * fma(1.194f, a, 0.265f));
  call.set("roughness_R", Float2{v, s});
  call.set("roughness_TT", Float2{v * square(call.number("scale_TT")), s});
  call.set("roughness_TRT", Float2{v * square(call.number("scale_TRT")), s});
}

}  // namespace nacre
