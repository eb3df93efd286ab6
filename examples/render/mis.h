#pragma once

#include <cmath>

namespace nacre::host {

/// Share of technique a at a point that a and b find with these densities:
/// a² / (a² + b²) (Veach 1997, "Robust Monte Carlo Methods", section 9.2.2), as
/// 1 / (1 + (b/a)²), which does not overflow to NaN. 0 where a is 0, else 1
/// where b is 0.
inline float power_heuristic(float a, float b) {
  if (!(a > 0.f)) return 0.f;
  if (!(b > 0.f) || !std::isfinite(a)) return 1.f;
  const float ratio = b / a;
  return 1.f / (1.f + ratio * ratio);
}

}  // namespace nacre::host
