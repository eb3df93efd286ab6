#include "nodes/texture2d/address.h"

#include <limits>

namespace nacre {

namespace {

/// The first of the texels that the point lies between, and t.
struct Position {
  Int texel;  ///< -1 ... size - 1.
  Float t;
};

Position between_centres(Float u, const Extent& extent) {
  const Float x = fma(u, extent.numeric, -0.5f);
  const Float below = floor(x);
  return {to_int(below), x - below};
}

Int last(const Extent& extent) { return extent.size - Int(1); }

/// Texel k in -2 ... size + 1, put back by reflection: -1 is 0, size is size - 1. The
/// last max is for images one texel wide, which reflect more than once.
Int reflected(Int k, const Extent& extent) {
  const Int up = k ^ (k >> Int(31));  // -1 - k where negative.
  return max(min(up, extent.size + last(extent) - up), Int(0));
}

Int clamped(Int k, const Extent& extent) { return min(max(k, Int(0)), last(extent)); }

/// The texel after k, in a ring.
Int after(Int k, const Extent& extent) {
  const Int next = k + Int(1);
  return select(next < extent.size, next, Int(0));
}

}  // namespace

Float address(Float u, AddressMode mode) {
  switch (mode) {
    case AddressMode::constant: return u;
    case AddressMode::clamp: {
      // NaN and +inf fail the comparison and count as 0; -inf is clamped to it.
      const Float inside = min(max(u, 0.0f), 1.0f);
      return select(u < std::numeric_limits<float>::infinity(), inside, 0.0f);
    }
    case AddressMode::periodic: {
      const Float t = u - floor(u);  // NaN where u is not finite.
      return select(t == t, t, 0.0f);
    }
    case AddressMode::mirror: {
      const Float t = fma(-2.0f, floor(u * 0.5f), u);
      return select(t == t, min(t, 2.0f - t), 0.0f);
    }
  }
  return u;
}

Bool outside(Float u, AddressMode mode) {
  if (mode != AddressMode::constant) return false;
  return !((u >= 0.0f) & (u <= 1.0f));
}

AddressMode within(AddressMode mode) {
  return mode == AddressMode::constant ? AddressMode::clamp : mode;
}

Taps closest_tap(Float u, const Extent& extent) {
  Taps taps;
  taps.count = 1;
  taps.texel[0] = min(to_int(u * extent.numeric), last(extent));
  return taps;
}

Taps linear_taps(Float u, const Extent& extent, AddressMode mode) {
  const Position at = between_centres(u, extent);
  Taps taps;
  taps.count = 2;
  taps.t = at.t;
  if (mode == AddressMode::periodic) {
    taps.texel[0] = select(at.texel < Int(0), last(extent), at.texel);
    taps.texel[1] = select(at.texel < last(extent), at.texel + Int(1), Int(0));
  } else {  // One texel beyond the edge, reflection and clamping agree.
    taps.texel[0] = max(at.texel, Int(0));
    taps.texel[1] = min(at.texel + Int(1), last(extent));
  }
  return taps;
}

Taps cubic_taps(Float u, const Extent& extent, AddressMode mode) {
  const Position at = between_centres(u, extent);
  Taps taps;
  taps.count = 4;
  taps.t = at.t;
  const Int first = at.texel - Int(1);
  if (mode == AddressMode::periodic) {
    // -2 + size is still negative in an image one texel wide.
    taps.texel[0] = max(select(first < Int(0), first + extent.size, first), Int(0));
    for (std::size_t k = 1; k < 4; ++k) taps.texel[k] = after(taps.texel[k - 1], extent);
    return taps;
  }
  for (std::size_t k = 0; k < 4; ++k) {
    const Int tap = first + Int(static_cast<std::int32_t>(k));
    taps.texel[k] = mode == AddressMode::mirror ? reflected(tap, extent) : clamped(tap, extent);
  }
  return taps;
}

Taps taps(Float u, const Extent& extent, TextureFilter filter, AddressMode mode) {
  switch (filter) {
    case TextureFilter::closest: return closest_tap(u, extent);
    case TextureFilter::linear: return linear_taps(u, extent, mode);
    case TextureFilter::cubic: return cubic_taps(u, extent, mode);
  }
  return {};
}

std::array<Float, 4> b_spline(Float t) {
  const Float s = 1.0f - t;
  const Float sixth(1.0f / 6.0f);
  return {s * s * s * sixth, fma(t * t, fma(t, 0.5f, -1.0f), 2.0f / 3.0f),
          fma(s * s, fma(s, 0.5f, -1.0f), 2.0f / 3.0f), t * t * t * sixth};
}

}  // namespace nacre
