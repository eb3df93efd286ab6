#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "examples/render/film.h"
#include "examples/render/pass_film.h"
#include "examples/render/passes.h"
#include "examples/render/tiles.h"

namespace nacre::host {

/// Samples of one pixel, added in the order of their index, in double so that many thousand do not
/// stall. How many there are its tile knows.
class PixelSum {
 public:
  void add(Vec3 rgb) {
    const double v[3] = {rgb.x, rgb.y, rgb.z};
    for (int c = 0; c < 3; ++c) sum_[c] += v[c], squares_[c] += v[c] * v[c];
  }
  Vec3 mean(int samples) const { return {mean(0, samples), mean(1, samples), mean(2, samples)}; }
  Vec3 variance_of_mean(int samples) const {
    return {variance(0, samples), variance(1, samples), variance(2, samples)};
  }

 private:
  float mean(int c, int samples) const { return static_cast<float>(sum_[c] / samples); }
  float variance(int c, int samples) const {
    if (samples < 2) return 0.f;
    const double spread = squares_[c] - sum_[c] * sum_[c] / samples;
    return static_cast<float>(std::max(0.0, spread) / (samples - 1) / samples);
  }

  double sum_[3] = {}, squares_[3] = {};
};

/// Sums of the samples of an image: as exact as if they were added in one go. Different pixels may
/// be added to at once.
class Accumulation {
 public:
  /// Of the pixels of `window`, for a film of some of them.
  Accumulation(const PassRequest& passes, const Film& film, const PixelWindow& window);

  /// Of a pixel of the image, for add().
  std::size_t index(int x, int y) const { return window_.index(x, y); }

  void add(std::size_t pixel, Vec3 radiance, float alpha) {
    sums_[pixel].add(radiance);
    if (!alphas_.empty()) alphas_[pixel] += static_cast<double>(alpha);
  }
  /// What passes need of sample number `sample` of a pixel.
  void add(std::size_t pixel, int sample, const PathRecord& record) {
    passes_.add(pixel, sample, record);
  }

  /// The root of the mean squared error of the pixels of a tile that has so many samples, relative
  /// to them (squared, and 0.01 for what is dark), as the variance of their samples says: those of
  /// a sampler that stratifies are better than that.
  double error(const Tile& tile, int samples) const;

  /// `done`: samples by tile, at least one each.
  void develop(const std::vector<Tile>& tiles, const std::vector<int>& done, Film& film) const;

  /// All of it, for a file; and back: false where it is of another image.
  void append_to(std::string& bytes) const;
  bool assign(std::string_view bytes);

 private:
  PixelWindow window_;
  std::vector<PixelSum> sums_;
  std::vector<double> alphas_;  ///< Empty where the film has none.
  PassSums passes_;
};

}  // namespace nacre::host
