#pragma once

#include <algorithm>
#include <cmath>

namespace nacre::host {

/// Linear to coded values, IEC 61966-2-1; clamped to [0, 1].
inline float srgb_encode(float linear) {
  const float v = std::clamp(linear, 0.0f, 1.0f);
  return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1.0f / 2.4f) - 0.055f;
}

}  // namespace nacre::host
