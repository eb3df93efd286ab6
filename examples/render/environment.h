#pragma once

#include <optional>
#include <string>
#include <vector>

#include "examples/render/distribution.h"
#include "examples/render/sampler.h"
#include "examples/render/vec.h"
#include "runtime/diagnostic.h"
#include "runtime/stop.h"
#include "runtime/texture/image_limits.h"

namespace nacre::host {

/// Light from infinitely far: a latitude-longitude image, +y up, the top row
/// towards +y, the middle of the image towards -z and its left quarter towards
/// -x, so u = ½ + atan2(x, -z)/2π, v = ½ - asin(y)/π from the top, as MaterialX
/// maps environments. Interpolated linearly.
///
/// Directions are drawn in proportion to the mean luminance of each texel's
/// solid angle and evenly within it, so the density has no singular poles and a
/// constant environment is the 1 by 1 image.
class Environment {
 public:
  /// `texels`: rgb radiance, row by row from the top, width * height.
  /// Non-finite and negative values become 0. `rotation`: radians about +y.
  Environment(int width, int height, std::vector<Vec3> texels, float rotation = 0.f);

  static Environment constant(Vec3 radiance) { return {1, 1, {radiance}}; }
  /// A photographer's dome: a dim grey gradient with two soft boxes and a strip; times `scale`.
  static Environment studio(float scale = 1.f, float rotation = 0.f);
  /// An image of any format that textures have, taken as linear Rec. 709 radiance times
  /// `scale`; one channel is grey. What counts as 0 is warned about. Nothing, with an error,
  /// for what cannot be read or is outside the limits.
  static std::optional<Environment> load(const std::string& path, float scale, float rotation,
                                         const ImageLimits& limits, Diagnostics& diagnostics,
                                         const Stop& stop = {});

  struct Light {
    Vec3 radiance;
    float pdf;  ///< Of sample(), per solid angle.
  };
  struct Sample {
    Vec3 wi;
    Vec3 radiance;
    float pdf = 0.f;  ///< Per solid angle; 0: a black environment, nothing drawn.
  };

  /// Along a unit vector.
  Light light(Vec3 direction) const;
  Sample sample(Uniform2 u) const;
  /// Mean luminance over the sphere.
  float mean_luminance() const { return mean_; }

 private:
  Vec3 texel(int x, int y) const;
  Vec3 between_texels(Vec2 position) const;
  float row_at(float cosine) const;
  float texel_solid_angle(int y) const;
  float texel_pdf(int x, int y) const;
  void build_tables();

  int width_, height_;
  std::vector<Vec3> texels_;
  float rotation_;
  Distribution rows_;
  std::vector<Distribution> columns_;  ///< By row.
  std::vector<float> latitudes_;       ///< Cosines to +y between the rows; height + 1.
  std::vector<float> row_densities_;   ///< Of a row, by the solid angle of one of its texels.
  float mean_ = 0.f;
};

}  // namespace nacre::host
