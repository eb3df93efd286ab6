#pragma once

#include <array>
#include <cstdint>

#include "runtime/texture/sampling.h"

namespace nacre {

/// Lookups of one call: structure of arrays of `count` floats. u, v are needed;
/// derivatives (of uv, per unit of screen x and y) may be null and then are zero.
struct TextureLookup {
  int count = 0;  ///< Points.
  /// (0, 0) is the lower left corner of the image.
  /// @{
  const float* u = nullptr;
  const float* v = nullptr;
  /// @}
  /// Null: zero.
  /// @{
  const float* dudx = nullptr;
  const float* dvdx = nullptr;
  const float* dudy = nullptr;
  const float* dvdy = nullptr;
  /// @}
  TextureFilter filter = TextureFilter::linear;  ///< As sampling.h says.
  AddressMode u_mode = AddressMode::periodic;    ///< Where u is outside [0, 1].
  AddressMode v_mode = AddressMode::periodic;    ///< Where v is outside [0, 1].
  int max_anisotropy = 1;                        ///< 1 .. largest_anisotropy.
};

/// An image whose texels are not in a texture's words: kernels look it up by a call. Thread-safe.
class TextureSampler {
 public:
  virtual ~TextureSampler() = default;

  /// Four arrays of `count` floats; channels the image lacks are 0 and alpha 1.
  virtual void lookup(const TextureLookup& points, const std::array<float*, 4>& rgba) const = 0;

  /// Reads of neighbouring texels that failed so far: those were 0.
  virtual std::uint64_t read_failures() const { return 0; }
};

}  // namespace nacre
