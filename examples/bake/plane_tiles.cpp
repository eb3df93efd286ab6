#include "examples/bake/plane_tiles.h"

#include <algorithm>
#include <cmath>

#include "examples/bake/adaptive_texels.h"
#include "examples/bake/plane.h"
#include "examples/bake/sample_set.h"

namespace nacre::host {

namespace {

/// Bytes of images that are kept for the next output, which often reads the same.
constexpr std::uint64_t most_unused = std::uint64_t{512} << 20;

int most_samples(const OutputKernel& kernel, std::size_t output, const Sampling& sampling) {
  if (!has_mean(kernel.outputs[output].type)) return 1;
  return sampling.count > 0 ? sampling.count : static_cast<int>(AdaptiveTexels::most_samples);
}

/// The corners of all points that are shaded, computed as those are.
TexelPoints corners(const BakeSettings& settings, int samples) {
  const std::vector<SamplePlace> places = sample_places(samples);
  const auto [left, right] = std::ranges::minmax(places, {}, &SamplePlace::x);
  const auto [top, bottom] = std::ranges::minmax(places, {}, &SamplePlace::y);
  const auto column = static_cast<float>(settings.width - 1);
  const auto row = static_cast<float>(settings.height - 1);
  return {.x = {left.x, column + right.x}, .y = {top.y, row + bottom.y}};
}

}  // namespace

OutputKernel with_tiles(const OutputKernel& kernel, std::size_t output,
                        const BakeSettings& settings, TextureStore& textures,
                        Diagnostics& diagnostics) {
  OutputKernel loaded = kernel;
  if (!kernel.kernel.has_deferred_tiles()) return loaded;
  if (textures.statistics().resident_bytes > most_unused) textures.drop_unused();
  const int samples = most_samples(kernel, output, settings.sampling);
  const Plane plane(settings.width, settings.height, area_of(settings));
  TexelPoints points = corners(settings, samples);
  std::vector<Range> ranges;
  for (const Channel& channel : kernel.kernel.program().inputs) {
    Range& range = ranges.emplace_back(HUGE_VAL, -HUGE_VAL, false);
    // All channels are linear in the place and in the footprint.
    for (const float footprint : {1.0f, 1.0f / std::sqrt(static_cast<float>(samples))}) {
      points.footprint = footprint;
      std::vector<float> values;
      plane.fill(channel.name, points, values);
      for (const float value : values) {
        range.low = std::min(range.low, static_cast<double>(value));
        range.high = std::max(range.high, static_cast<double>(value));
      }
    }
  }
  loaded.kernel = kernel.kernel.within(ranges, diagnostics);
  return loaded;
}

}  // namespace nacre::host
