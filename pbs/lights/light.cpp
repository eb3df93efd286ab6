#include "pbs/light.h"

#include <limits>

#include "pbs/edf.h"
#include "runtime/node/geometry.h"
#include "runtime/node/node_call.h"

namespace nacre {

LightPtr as_light(const ClosurePtr& closure) {
  return std::dynamic_pointer_cast<const Light>(closure);
}

Light point_source(Recorder& recorder, Float3 position, Color3 power, Float decay_rate) {
  const Float3 way = position - nacre::position(recorder, Space::world);
  // Over its largest component, so that no square overflows or vanishes.
  const Float largest = max_component({abs(way.x), abs(way.y), abs(way.z)});
  const Float sum = way.x + way.y + way.z;
  // A NaN is in the sum alone.
  const Bool apart =
      (largest > 0.0f) & (largest <= std::numeric_limits<float>::max()) & (sum == sum);
  // The reciprocal of more than 2^126 is too small for a normal number.
  const Float near = select(largest > 0x1p100f, Float(0x1p-100f), Float(1.0f));
  const Float3 scaled = (way * Float3(near)) / Float3(select(apart, largest * near, 1.0f));
  const Float length = sqrt(dot(scaled, scaled));
  const Float distance = largest * length;
  const Float3 unit = scaled * Float3(1.0f / length);
  const Float falloff = pow(distance + 1.0f, decay_rate);
  Light light;
  light.intensity = power / Float3(falloff);
  light.direction = {select(apart, unit.x, 0.0f), select(apart, unit.y, 0.0f),
                     select(apart, unit.z, 0.0f)};
  light.distance = select(apart, min(distance, std::numeric_limits<float>::max()), 0.0f);
  return light;
}

/// light: an EDF, times intensity * 2^exposure. MaterialX PBS 1.39, "light". Factors below
/// zero, and NaN, count as zero.
void record_closure_light(NodeCall& call) {
  auto light = std::make_shared<Light>();
  if (const EdfPtr edf = as_edf(call.closure("edf")); edf != nullptr) {
    Recorder& recorder = call.recorder();
    const View view{
        .recorder = &recorder, .accuracy = call.accuracy(), .wo = view_direction(recorder)};
    const Float factor = max(call.number("intensity") * exp2(call.number("exposure")), 0.0f);
    light->intensity = product(radiance(edf, view), Color3(factor));
  }
  call.set(std::move(light));
}

}  // namespace nacre
