#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace nacre::bench {

/// Batches enough that random look-ups do not find their texels in the L2 cache.
inline constexpr std::size_t lookup_batches = 64;

/// Where an image is looked up: `lookup_batches` batches, one after another.
struct Lookups {
  std::vector<float> u, v;
  std::vector<float> draw;  ///< A number in [0, 1) for each point.
  /// The axes of the footprint, in uv: (aspect * footprint, 0) and (0, footprint).
  float footprint = 0.0f;
  float aspect = 1.0f;
};

/// Blocks of 64 x 64 points a texel apart, as a camera or a bake sees a texture.
Lookups coherent_lookups(float footprint_texels);
/// Anywhere, as after a diffuse bounce.
Lookups random_lookups(float footprint_texels);

/// rgba of each point.
using Rgba = std::array<std::vector<float>, 4>;

enum class Filter { closest, bilinear, trilinear, anisotropic };
const char* filter_name(Filter filter);

}  // namespace nacre::bench
