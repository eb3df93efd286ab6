#pragma once

#include <optional>

#include "examples/render/light_bounds.h"
#include "examples/render/shader.h"

namespace nacre::host {

/// Light as a point sees it.
struct LightLanes {
  Lanes3 intensity;           ///< rgb: irradiance across the direction.
  Lanes3 direction;           ///< World, from the point to the light; 0: there is none.
  float* distance = nullptr;  ///< To the light; infinite where it is nowhere.
};

/// A light that no ray meets: of no extent, or infinitely far away. Calls are const and come from
/// several threads at once.
class LightShader {
 public:
  virtual ~LightShader() = default;
  /// Of the batch it reads P, the time and the frame.
  virtual void light(const ShadingBatch& batch, LightLanes out) const = 0;
  /// Where it is and shines at all times, if it is somewhere and that is known. Beyond what they
  /// allow nothing arrives; within, intensity by the square of the distance is the best guess.
  virtual std::optional<LightBounds> bounds() const { return {}; }
};

}  // namespace nacre::host
