#include "nodes/math/safe.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// Absorption coefficient of hair that scatters to that colour: (ln C / f(beta))^2
/// with the quintic f of Chiang et al., "A Practical and Controllable Hair and Fur
/// Model for Production Path Tracing", 2016. MaterialX 1.39 Physically Based Shading
/// Nodes, "chiang_hair_absorption_from_color". Colours are limited to [0.001, 1].
/// NaN counts as 0.001; 0 where the roughness makes f infinite or NaN.
void record_chiang_hair_absorption_from_color(NodeCall& call) {
  const Float beta = call.number("azimuthal_roughness");
  Float f = 0.0f;
  for (const float coefficient : {0.245f, 5.574f, -10.73f, 2.532f, -0.215f, 5.969f}) {
    f = fma(f, beta, coefficient);
  }
  const Float3 color = call.vector3("color");
  const auto absorption = [&](Float c) {
    return square(safe_divide(log(clamp(c, 0.001f, 1.0f)), f));
  };
  call.set(Float3(absorption(color.x), absorption(color.y), absorption(color.z)));
}

}  // namespace nacre
