#include "pbs/view.h"

#include <limits>

namespace nacre {

Frame make_frame(Float3 n) {
  const Float sign = copysign(1.0f, n.z);
  const Float a = -1.0f / (sign + n.z);
  const Float b = n.x * n.y * a;
  return {{fma(sign * n.x * n.x, a, 1.0f), sign * b, -sign * n.x},
          {b, fma(n.y * n.y, a, sign), -n.y},
          n};
}

Frame make_frame(Float3 n, Float3 tangent) {
  const Float3 projected = tangent - n * Float3(dot(n, tangent));
  const Float squared = dot(projected, projected);
  const Frame any = make_frame(n);
  // Below this the direction is rounding: |tangent| is 1 or the host's mistake.
  const Bool usable = squared > 1e-10f;
  const Float3 x = select(usable, projected * Float3(1.0f / sqrt(squared)), any.x);
  return {x, cross(n, x), n};
}

Float3 facing(Float3 n, Float3 wo) {
  const Bool away = dot(wo, n) < 0.0f;  // As Frame::to_local() has it: one value.
  return select(away, -n, n);
}

Frame facing_frame(Float3 n, Float3 wo) {
  Frame frame = make_frame(n);
  frame.z = facing(n, wo);
  return frame;
}

Float facing_cosine(Float3 n, Float3 wo) { return min(abs(dot(wo, n)), 1.0f); }

Color3 product(Color3 x, Color3 y) {
  const auto one = [](Float a, Float b) {
    if (a.is_constant(0.0f) || b.is_constant(0.0f)) return Float(0.0f);
    return a * b;
  };
  return {one(x.x, y.x), one(x.y, y.y), one(x.z, y.z)};
}

Color3 finite_light(Color3 light) {
  if (is_zero(light)) return light;
  constexpr float largest = std::numeric_limits<float>::max();
  const auto one = [](Float x) {
    return select(x == x, min(max(x, -largest), largest), Float(0.0f));
  };
  return {one(light.x), one(light.y), one(light.z)};
}

Float keep(Recorder& recorder, Float x) { return Float(recorder.keep(x.ref())); }
Int keep(Recorder& recorder, Int x) { return Int(recorder.keep(x.ref())); }
Bool keep(Recorder& recorder, Bool x) { return Bool(recorder.keep(x.ref())); }

Float2 keep(Recorder& recorder, Float2 v) { return {keep(recorder, v.x), keep(recorder, v.y)}; }

Float3 keep(Recorder& recorder, Float3 v) {
  return {keep(recorder, v.x), keep(recorder, v.y), keep(recorder, v.z)};
}

}  // namespace nacre
