#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "examples/render/vec.h"

namespace nacre::host {

/// Moves a surface point off its surface, to the side of `n`, far enough that a
/// ray from there cannot meet the surface again, whatever the scale of the
/// scene: a fixed number of representable floats per axis, and a fixed distance
/// near the origin, where floats are dense.
/// Wächter and Binder 2019, "A Fast and Robust Method for Avoiding
/// Self-Intersection", Ray Tracing Gems, chapter 6; constants of that chapter.
/// `p` has to be interpolated from the corners, not computed from a ray distance.
inline Vec3 offset_point(Vec3 p, Vec3 n) {
  constexpr float origin = 1.f / 32.f;
  constexpr float float_scale = 1.f / 65536.f;
  constexpr float int_scale = 256.f;
  const auto shift = [](float x, float nx) {
    const auto ulps = static_cast<std::int32_t>(int_scale * nx);
    if (std::abs(x) < origin) return x + float_scale * nx;
    // Float bits grow with magnitude, so against the sign they must shrink.
    return std::bit_cast<float>(std::bit_cast<std::int32_t>(x) + (x < 0.f ? -ulps : ulps));
  };
  return {shift(p.x, n.x), shift(p.y, n.y), shift(p.z, n.z)};
}

}  // namespace nacre::host
