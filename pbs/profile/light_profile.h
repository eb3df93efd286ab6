#pragma once

#include <vector>

namespace nacre {

/// How strongly a luminaire shines into each direction, as measured: IESNA LM-63-2002, of which
/// photometric types and the symmetries are; coordinates are those of IES LM-75-01.
///
/// Directions here have z along the main axis of the luminaire (straight down, of a ceiling's lamp;
/// the aim, of a floodlight) and x and y across it.
struct LightProfile {
  static constexpr float shortest_step = 0.01f;
  enum class Type {
    c = 1,  ///< Vertical angle from +z, horizontal angle around z from +x to +y.
    b = 2,  ///< Vertical angle around x from +z to +y, horizontal angle out of that plane to +x.
    a = 3,  ///< Horizontal angle around y from +z to +x, vertical angle out of that plane to +y.
  };
  Type type = Type::c;
  /// Degrees, growing by shortest_step at least; two or more, but one horizontal angle where all
  /// around is the same.
  /// @{
  std::vector<float> vertical, horizontal;
  /// @}
  /// In candela, at least 0, finite; the vertical angle is the faster.
  std::vector<float> intensity;
};

/// The integral of intensity |cos| over all directions, cos being their z: what a surface that has
/// `intensity` for radiance emits from both its sides. Symmetries count; where nothing was measured
/// it is dark.
double emittance(const LightProfile& profile);

}  // namespace nacre
