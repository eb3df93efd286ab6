#pragma once

#include <cstdint>

/// @file
/// What a texture lookup means: the recorded sampler, the tiled one and the tests'
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
/// Footprint. In texels of level 0, which is w x h, a pixel has the axes X = (dudx w,
/// dvdx h) and Y = (dudy w, dvdy h), each number first bounded to [-1024, 1024] uv; a
/// footprint with a NaN counts as none. The circle through them is an ellipse with half
/// axes major >= minor, the singular values of [X Y]. It is read as Feline does
/// (McCormack, Perry, Farkas, Jouppi, SIGGRAPH 1999): by probes as wide as the minor axis
/// along the major one. With A the largest anisotropy allowed:
///
///   width   r = minor; beyond an anisotropy of A the two halves of the error are shared
///           out: major' = (major + A minor) / 2 and r = major' / A stand for the axes
///   level   k = floor(log2(max(r, 1))), at most the last; the blend of the levels k and
///           k + 1 by t = r / 2^k - 1 (none on the last level): linear in the width, at
///           most 0.09 from log2(r) and without a logarithm
///   probes  a = major / max(r, 1/2) in [1, A], n = max(1, floor(2 a - 1 + 1/1024)):
///           the last term keeps whole ratios, which are common, from rounding either way
///   places  p (major - r) along the major axis, p = (2 i + 1) / n - 1 for i in 0 .. n - 1
///   weights exp(-2 (p major / (2 (major - r)))^2) over their sum
///
/// A = 1 is trilinear filtering by the mean of the axes. Numbers of probes, blend and weights
/// are OpenImageIO's (texturesys.cpp, 2.4: compute_miplevels, compute_ellipse_sampling,
/// anisotropic_aspect), so that a look keeps its sharpness between renderers that use it
/// and this one; Feline's paper has flatter weights. Unlike there, the ellipse is that of
/// texels, not of uv: on images that are not square the shape of a texel counts.
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

inline constexpr int default_anisotropy = 32;  ///< Of ShaderOptions; OpenImageIO's, too.
inline constexpr int largest_anisotropy = 64;  ///< Who asks for more gets this.

/// How texels are weighed; see above.
enum class TextureFilter { closest, linear, cubic };
/// What coordinates outside [0, 1] mean.
enum class AddressMode { constant, clamp, periodic, mirror };

/// Filter and address modes as one number: the immediate of Op::texture_call.
struct TextureModes {
  TextureFilter filter = TextureFilter::linear;  ///< How texels are weighed.
  AddressMode u = AddressMode::periodic;         ///< Of the first coordinate.
  AddressMode v = AddressMode::periodic;         ///< Of the second coordinate.
  int max_anisotropy = 1;                        ///< 1 .. largest_anisotropy.
};
/// Four bits each from the lowest: filter, u, v, and the anisotropy above.
constexpr std::uint32_t pack_modes(TextureModes modes) {
  return static_cast<std::uint32_t>(modes.filter) | static_cast<std::uint32_t>(modes.u) << 4 |
         static_cast<std::uint32_t>(modes.v) << 8 |
         static_cast<std::uint32_t>(modes.max_anisotropy) << 12;
}
/// The inverse.
constexpr TextureModes unpack_modes(std::uint32_t packed) {
  return {static_cast<TextureFilter>(packed & 3u), static_cast<AddressMode>((packed >> 4) & 3u),
          static_cast<AddressMode>((packed >> 8) & 3u), static_cast<int>(packed >> 12)};
}

}  // namespace nacre
