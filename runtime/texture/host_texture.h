#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>

#include "runtime/texture/sampling.h"
#include "runtime/texture/texel.h"
#include "runtime/texture/tile_cache.h"

namespace nacre {

/// Lookups of one call: structure of arrays of `count` floats. u, v are needed;
/// derivatives (of uv, per unit of screen x and y) may be null and then are zero.
struct HostLookup {
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

/// An image too large to be resident, sampled as sampling.h says from tiles that
/// OpenImageIO's cache brings in. Level 0 gives what the resident sampler would give;
/// coarser levels are the file's own (.tx) or made by the cache, which rounds them to
/// the file's format.
///
/// `constant` is treated as `clamp`: the caller, who knows the default, replaces the
/// lanes outside. NaN and infinite texels are 0, and so are denormal ones. A texel that
/// cannot be read is 0, and counted.
///
/// Thread-safe. Does not need or keep any floating-point state beyond rounding to nearest.
class HostTexture {
 public:
  /// A file that `cache` has opened for the image `info`.
  HostTexture(std::shared_ptr<TileCache> cache, std::shared_ptr<TileCache::File> file,
              const ImageInfo& info);

  /// Four arrays of `count` floats; channels the image lacks are 0 and alpha 1.
  void lookup(const HostLookup& points, const std::array<float*, 4>& rgba) const;

  /// Reads of neighbouring texels that failed so far: those were 0.
  std::uint64_t read_failures() const { return read_failures_.load(std::memory_order_relaxed); }

 private:
  struct Taps;
  struct Probes;
  Rgba sample(const HostLookup& points, int lane) const;
  Rgba filter_level(float u, float v, int level, const HostLookup& points) const;
  Rgba gather(const Taps& across, const Taps& up, int level) const;
  void read_texels(int level, int x0, int x1, int y0, int y1, Rgba* out) const;
  Probes find_probes(const HostLookup& points, int lane) const;

  std::shared_ptr<TileCache> cache_;
  std::shared_ptr<TileCache::File> file_;
  ImageInfo info_;
  int levels_ = 1;
  mutable std::atomic<std::uint64_t> read_failures_{0};
};

}  // namespace nacre
