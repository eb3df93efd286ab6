#include "pbs/subsurface_medium.h"

#include "runtime/value/vector.h"

namespace nacre {

namespace {

/// The root below 1 of 0.139 s² - (1.139 + 1.17 albedo) s + 1 - albedo, van de Hulst's fit times
/// its denominator: 2 c / (b + root) and not (b - root) / 2 a.
Float similarity(Float albedo) {
  const Float b = fma(1.17f, albedo, 1.139f);
  const Float c = 1.0f - albedo;
  return 2.0f * c / (b + sqrt(fma(b, b, -0.556f * c)));
}

}  // namespace

Vdf subsurface_medium(Color3 albedo, Color3 radius, Float anisotropy) {
  const Float g = clamp(anisotropy, -0.999f, 0.999f);
  Vdf medium;
  medium.anisotropy = g;
  const Float albedos[] = {albedo.x, albedo.y, albedo.z};
  const Float radii[] = {radius.x, radius.y, radius.z};
  Float absorbed[3], scattered[3];
  for (int c = 0; c < 3; ++c) {
    const Float s2 = square(similarity(albedos[c]));
    // What is absorbed of 1 goes its own way: where it is little, 1 - scattered has no digits.
    const Float extinction = 1.0f / (fma(-g, s2, 1.0f) * clamp(radii[c], 1e-6f, 1e6f));
    absorbed[c] = s2 * (1.0f - g) * extinction;
    scattered[c] = (1.0f - s2) * extinction;
  }
  medium.absorption = {absorbed[0], absorbed[1], absorbed[2]};
  medium.scattering = {scattered[0], scattered[1], scattered[2]};
  return medium;
}

}  // namespace nacre
