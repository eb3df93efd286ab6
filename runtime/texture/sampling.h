#pragma once

#include <cstdint>

/// What a texture lookup means: the recorded sampler, the host path and the tests'
/// oracle all implement this page.
///
/// Coordinates. uv (0,0) is the lower left corner of the image, (1,1) the upper right
/// (MaterialX 1.39 Standard Nodes, `image`; address modes from the same section):
///
///   constant  u or v outside [0,1], or not finite: the node's `default`. Else as clamp.
///   clamp     u = min(max(u, 0), 1)
///   periodic  u = u - floor(u)
///   mirror    t = u - 2 floor(u / 2); u = t > 1 ? 2 - t : t
///
/// and a coordinate that is not finite counts as 0. A tap that then falls outside the
/// image is: the edge texel (constant, clamp), the texel modulo the width (periodic),
/// the reflected texel, -1 being 0 and -2 being 1 (mirror).
///
/// Level. With the footprint (dudx, dvdx), (dudy, dvdy) and level 0 of w x h texels,
/// rho^2 = max((dudx w)^2 + (dvdx h)^2, (dudy w)^2 + (dvdy h)^2), isotropic by the larger
/// axis; lambda = log2(rho) between 0 and the last level (NaN counts as 0). The result
/// is the linear blend of the levels floor(lambda) and floor(lambda) + 1.
///
/// Filters, on a level of w x h texels:
///
///   closest  texel floor(u w), floor(v h) of level 0, whatever the footprint: the
///            standard calls it "nearest-neighbor single-sample", and identifiers and
///            masks must come back unmixed. u = 1 is the last texel.
///   linear   x = u w - 1/2; taps floor(x), floor(x) + 1, weights 1 - t, t.
///   cubic    x = u w - 1/2; taps floor(x) - 1 .. floor(x) + 2, uniform cubic B-spline.
///            The standard says only "cubic". The B-spline has weights in [0, 1]: it
///            never leaves the range of the texels, so colours stay positive and
///            roughness below 1, and it is twice differentiable, which bump mapping
///            wants. OSL's "bicubic" (so MaterialX's OSL target) is the same kernel.
///            Catmull-Rom would interpolate but overshoot. Used on both levels.
namespace nacre {

enum class TextureFilter { closest, linear, cubic };
enum class AddressMode { constant, clamp, periodic, mirror };

/// Filter and address modes as one number: the immediate of Op::texture_call.
struct TextureModes {
  TextureFilter filter = TextureFilter::linear;
  AddressMode u = AddressMode::periodic;
  AddressMode v = AddressMode::periodic;
};
constexpr std::uint32_t pack_modes(TextureModes modes) {
  return static_cast<std::uint32_t>(modes.filter) | static_cast<std::uint32_t>(modes.u) << 4 |
         static_cast<std::uint32_t>(modes.v) << 8;
}
constexpr TextureModes unpack_modes(std::uint32_t packed) {
  return {static_cast<TextureFilter>(packed & 3u), static_cast<AddressMode>((packed >> 4) & 3u),
          static_cast<AddressMode>((packed >> 8) & 3u)};
}

}  // namespace nacre
