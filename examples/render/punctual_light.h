#pragma once

#include <string>

#include "examples/render/light_shader.h"
#include "examples/render/vec.h"

namespace nacre::host {

/// A light of a glTF file: KHR_lights_punctual. Its photometric numbers count as radiometric ones,
/// as those of emissive materials do: candela as intensity, lux as irradiance.
struct PunctualLight {
  enum class Kind { directional, point, spot };
  std::string name = {};  ///< Of its node; may be empty.
  Kind kind = Kind::point;
  Vec3 color;             ///< Times the intensity.
  Vec3 position;          ///< World; of point and spot.
  Vec3 direction;         ///< World, unit: where it goes; of directional and spot.
  float range = 0.f;      ///< Beyond it there is no light; 0: without bound.
  float inner_cos = 1.f;  ///< Cosines of the angles to the axis of a spot: full within,
  float outer_cos = 0.f;  ///< none beyond.
};

/// What a point at P sees of it: inverse squares, windowed by the range, and a spot's cone as the
/// extension suggests ("Range Property", "Inner and Outer Cone Angles").
class PunctualShader final : public LightShader {
 public:
  explicit PunctualShader(const PunctualLight& light) : light_(light) {}
  void light(const ShadingBatch& batch, LightLanes out) const override;
  std::optional<LightBounds> bounds() const override;

 private:
  PunctualLight light_;
};

}  // namespace nacre::host
