#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "examples/render/distribution.h"
#include "examples/render/sampler.h"
#include "examples/render/sky_map.h"
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
  /// What sample() may draw.
  enum class Drawn {
    all,
    /// In proportion to what texels have above the mean of the sphere, and never the others: for
    /// paths whose own directions find those, weighed by both densities, with less noise. That is
    /// what is left of twice the light's share once a density even over a hemisphere has been
    /// taken off (Karlik, Sik, Vevoda, Skrivan, Krivanek 2019, "MIS Compensation: Optimizing
    /// Sampling Techniques in Multiple Importance Sampling"). An even sky is drawn whole. Not for
    /// Strategy::light_only, which would miss the rest.
    above_mean,
  };

  /// `texels`: rgb radiance, row by row from the top, width * height.
  /// Non-finite and negative values become 0. `rotation`: radians about +y.
  Environment(int width, int height, const std::vector<Vec3>& texels, float rotation = 0.f,
              Drawn drawn = Drawn::all);

  static Environment constant(Vec3 radiance) { return {1, 1, {radiance}}; }
  /// A photographer's dome: a dim grey gradient with two soft boxes and a strip; times `scale`.
  static Environment studio(float scale = 1.f, float rotation = 0.f, Drawn drawn = Drawn::all);
  /// An image of any format that textures have, taken as linear Rec. 709 radiance times
  /// `scale`; one channel is grey. What counts as 0 is warned about. Nothing, with an error,
  /// for what cannot be read or is outside the limits.
  static std::optional<Environment> load(const std::string& path, float scale, float rotation,
                                         const ImageLimits& limits, Diagnostics& diagnostics,
                                         const Stop& stop = {}, Drawn drawn = Drawn::all);

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
  /// The same for many, to the bit: nobody waits for each place of the image by itself. As many
  /// results as there are directions, or pairs.
  void light(std::span<const Vec3> directions, std::span<Light> lights) const;
  void sample(std::span<const Uniform2> u, std::span<Sample> samples) const;
  /// Whether sample() draws wherever there is light.
  bool draws_all() const { return draws_all_; }
  /// Mean luminance over the sphere.
  float mean_luminance() const { return mean_; }

 private:
  /// Red, green, blue, and the chance to be drawn among those of its row.
  using Texel [[gnu::vector_size(4 * sizeof(float))]] = float;
  /// A texel, and how far behind its middle.
  struct Corner {
    std::size_t first;
    float s, t;
  };

  std::size_t at(int x, int y) const;
  Vec3 radiance(int x, int y) const;
  Corner corner(Vec2 position) const;
  void fetch(Vec2 position) const;
  Vec3 between_texels(Vec2 position) const;
  Light light_at(Vec2 position) const;
  void sample_block(std::span<const Uniform2> u, Sample* samples) const;
  float texel_solid_angle(int y) const;
  float texel_pdf(int x, int y) const;
  void build_tables(Drawn drawn);
  double find_weights();
  double excess(float dim) const;

  int width_, height_;
  std::vector<Texel> texels_;  ///< With those around the image.
  SkyMap map_;
  Distribution rows_;
  std::vector<Distribution> columns_;  ///< By row.
  std::vector<float> latitudes_;       ///< Cosines to +y between the rows; height + 1.
  std::vector<float> row_densities_;   ///< Of a row, by the solid angle of one of its texels.
  float mean_ = 0.f;
  bool draws_all_ = true;
};

}  // namespace nacre::host
