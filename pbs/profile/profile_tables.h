#pragma once

#include <cmath>
#include <vector>

#include "pbs/profile/light_profile.h"
#include "pbs/sampling.h"

namespace nacre {

/// The density of directions that a profile is sampled with: its intensity times these, of the
/// vertical and of the horizontal angle in radians. That is solid angle by angles times the cosine
/// to the main axis, but for least_cosine. T is a number or a recorded one.
/// @{
template <class T>
T vertical_weight(LightProfile::Type type, T angle) {
  using std::abs, std::cos, std::sin;
  const T cosine = cos(angle);
  if (type == LightProfile::Type::c) return (abs(cosine) + T(least_cosine)) * sin(angle);
  if (type == LightProfile::Type::b) return cosine + T(least_cosine);
  return (cosine + T(least_cosine)) * cosine;
}
template <class T>
T horizontal_weight(LightProfile::Type type, T angle) {
  using std::cos;
  if (type == LightProfile::Type::c) return T(1.0f);
  const T cosine = cos(angle);
  if (type == LightProfile::Type::a) return cosine + T(least_cosine);
  return (cosine + T(least_cosine)) * cosine;
}
/// @}

/// What is left of a profile's directions once symmetries are folded: those that are mirrored by
/// the sign of x or of y, too.
struct Mirrors {
  bool x = false, y = false;
};
Mirrors mirrors_of(const LightProfile& profile);

/// A profile with integrals to sample it by: linear between its angles, of which no two are further
/// apart than 10 degrees, and none of the kinks of a weight lies between two.
struct ProfileTables {
  /// Degrees; one horizontal angle where all around is the same.
  /// @{
  std::vector<float> vertical, horizontal;
  /// @}
  std::vector<float> intensity;  ///< The vertical angle is the faster.
  /// At each of those: the integral of intensity and vertical weight, up to that vertical angle.
  std::vector<float> below;
  /// At each horizontal angle: the integral of all of `below` and horizontal weight up to there.
  std::vector<float> before;
  /// The integral of the density over all directions, mirrored ones too; in radians.
  double total = 0.0;
};

/// For a profile as parse_ies() gives it.
ProfileTables make_profile_tables(const LightProfile& profile);

}  // namespace nacre
