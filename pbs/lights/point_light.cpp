#include "pbs/light.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// point_light: equal in all directions; point_source says how it falls off and what it is
/// at the light. MaterialX 1.39.5 data library, lights/; the standard has no lights.
void record_closure_point_light(NodeCall& call) {
  const Color3 power = call.vector3("color") * Color3(call.number("intensity"));
  call.set(std::make_shared<Light>(
      point_source(call.recorder(), call.vector3("position"), power, call.number("decay_rate"))));
}

}  // namespace nacre
