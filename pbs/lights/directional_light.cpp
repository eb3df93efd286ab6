#include "pbs/light.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// directional_light: the same everywhere; `direction` is where the light goes, and taken
/// as it is given, but finite as light is. MaterialX 1.39.5 data library, lights/.
void record_closure_directional_light(NodeCall& call) {
  auto light = std::make_shared<Light>();
  light->intensity = call.vector3("color") * Color3(call.number("intensity"));
  light->direction = finite_light(-call.vector3("direction"));
  call.set(std::move(light));
}

}  // namespace nacre
