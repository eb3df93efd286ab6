#pragma once

#include <cstddef>

#include "examples/render/vec.h"

namespace nacre::host {

/// Where directions are in an image of the sky by latitude and longitude: +y up, the top row
/// towards +y, the middle of the image towards -z and its left quarter towards -x.
class SkyMap {
 public:
  /// Directions, or places, that are asked for together at most.
  static constexpr std::size_t block_size = 64;

  SkyMap() = default;
  /// `rotation`: radians about +y.
  SkyMap(int width, int height, float rotation);

  /// The positions of unit vectors, in texels: in [0, width) and [0, height).
  void positions_of(const Vec3* directions, std::size_t count, Vec2* positions) const;

  /// By a column, in texels, and the cosine to +y.
  struct Place {
    float column, height;
  };
  /// Unit vectors to places, and the positions of these.
  void directions_to(const Place* places, std::size_t count, Vec3* directions,
                     Vec2* positions) const;

 private:
  float width_ = 1.f, height_ = 1.f;
  float turns_ = 0.f;  ///< By which it is rotated.
};

}  // namespace nacre::host
