#pragma once

#include <memory>
#include <optional>

#include "pbs/view.h"
#include "runtime/node/recorded.h"

namespace nacre {

/// A light shader. Lights that a point sees have a direction, and P is the point that is
/// lit; `light` has none, and P is a point of the emitter, seen from wo.
class Light final : public Closure {
 public:
  /// Irradiance across the direction, or radiance to wo; shader_channels() makes it finite.
  Color3 intensity = Color3(0.0f);
  std::optional<Float3> direction;  ///< Unit, world space, from P to the light.
  std::optional<Float> distance;    ///< From P to the light; none: infinitely far away.
};
using LightPtr = std::shared_ptr<const Light>;

LightPtr as_light(const ClosurePtr& closure);

/// A light at `position` as the point P sees it: color * intensity / (d + 1)^decay_rate at
/// the distance d, finite at the light itself. Where P is the light, or infinitely far from it, its
/// direction is 0.
Light point_source(Recorder& recorder, Float3 position, Color3 power, Float decay_rate);

}  // namespace nacre
