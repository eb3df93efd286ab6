#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>

#include "runtime/texture/texel.h"
#include "runtime/texture/texture_sampler.h"
#include "runtime/texture/tile_cache.h"

namespace nacre {

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
class TiledTexture final : public TextureSampler {
 public:
  /// A file that `cache` has opened for the image `info`.
  TiledTexture(std::shared_ptr<TileCache> cache, std::shared_ptr<TileCache::File> file,
               const ImageInfo& info);

  void lookup(const TextureLookup& points, const std::array<float*, 4>& rgba) const override;
  std::uint64_t read_failures() const override {
    return read_failures_.load(std::memory_order_relaxed);
  }

 private:
  struct Taps;
  struct Probes;
  Rgba sample(const TextureLookup& points, int lane) const;
  Rgba filter_level(float u, float v, int level, const TextureLookup& points) const;
  Rgba gather(const Taps& across, const Taps& up, int level) const;
  void read_texels(int level, int x0, int x1, int y0, int y1, Rgba* out) const;
  Probes find_probes(const TextureLookup& points, int lane) const;

  std::shared_ptr<TileCache> cache_;
  std::shared_ptr<TileCache::File> file_;
  ImageInfo info_;
  int levels_ = 1;
  mutable std::atomic<std::uint64_t> read_failures_{0};
};

}  // namespace nacre
