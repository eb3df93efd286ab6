#include "pbs/light.h"
#include "runtime/node/node_call.h"

namespace nacre {

namespace {

/// Hermite's step; where the edges meet, or are not numbers, a step at `high`.
Float smooth_step(Float low, Float high, Float x) {
  const Float t = saturate((x - low) / (high - low));
  const Float step = select(x >= high, Float(1.0f), Float(0.0f));
  return select(low < high, t * t * fma(-2.0f, t, 3.0f), step);
}

}  // namespace

/// spot_light: a point light within a cone around `direction`, which is taken as it is
/// given. inner_angle and outer_angle are cosines: the data library's text compares them
/// with one, and blends from the lesser of them up to the inner. MaterialX 1.39.5 data
/// library, lights/.
void record_closure_spot_light(NodeCall& call) {
  const Color3 power = call.vector3("color") * Color3(call.number("intensity"));
  Light light =
      point_source(call.recorder(), call.vector3("position"), power, call.number("decay_rate"));
  const Float inner = call.number("inner_angle");
  const Float low = min(inner, call.number("outer_angle"));
  const Float cosine = dot(*light.direction, -call.vector3("direction"));
  light.intensity = light.intensity * Color3(smooth_step(low, inner, cosine));
  call.set(std::make_shared<Light>(light));
}

}  // namespace nacre
