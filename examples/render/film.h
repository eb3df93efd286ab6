#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "examples/render/pass_film.h"
#include "examples/render/pixel_window.h"
#include "examples/render/vec.h"

namespace nacre::host {

/// An image of radiance estimates, rows from the top, or a window of one: pixels are called by
/// where they are in the whole image.
class Film {
 public:
  /// Without alpha it is 1 everywhere.
  Film(int width, int height, bool has_alpha = false)
      : Film(width, height, has_alpha, {0, 0, width, height}) {}
  /// `window`: of the image's pixels, those that the film has.
  Film(int width, int height, bool has_alpha, const PixelWindow& window)
      : width_(width),
        height_(height),
        window_(window),
        mean_(window.pixels()),
        variance_(window.pixels()),
        alpha_(has_alpha ? window.pixels() : 0, 1.f) {}

  /// Of the whole image.
  int width() const { return width_; }
  int height() const { return height_; }
  /// What there is of it.
  const PixelWindow& window() const { return window_; }

  /// Mean over the samples of a pixel.
  Vec3& mean(int x, int y) { return mean_[index(x, y)]; }
  Vec3 mean(int x, int y) const { return mean_[index(x, y)]; }

  /// Estimated variance of that mean; meaningful for independent samples, an
  /// overestimate for stratified ones.
  Vec3& variance(int x, int y) { return variance_[index(x, y)]; }
  Vec3 variance(int x, int y) const { return variance_[index(x, y)]; }

  /// Share of the pixel that is not held out by a matte; `mean` is multiplied by it.
  bool has_alpha() const { return !alpha_.empty(); }
  float alpha(int x, int y) const { return has_alpha() ? alpha_[index(x, y)] : 1.f; }
  void set_alpha(int x, int y, float alpha) { alpha_[index(x, y)] = alpha; }

  /// Of a pixel in all of them.
  std::size_t index(int x, int y) const { return window_.index(x, y); }

  /// Images beside this one, of the same size.
  PassFilm passes;

  /// An rgb triple for each of the window.
  const std::vector<Vec3>& pixels() const { return mean_; }
  std::vector<Vec3>& pixels() { return mean_; }

  std::string denoised_by;  ///< "": nothing did.

 private:
  int width_, height_;
  PixelWindow window_;
  std::vector<Vec3> mean_, variance_;
  std::vector<float> alpha_;
};

}  // namespace nacre::host
