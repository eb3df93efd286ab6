#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "examples/render/film.h"
#include "examples/render/pass_film.h"
#include "examples/render/passes.h"
#include "examples/render/tiles.h"

namespace nacre::host {

/// Sums of the samples of an image: as exact as if they were added in one go.
class Accumulation {
 public:
  /// Like the film that is to be made of it.
  Accumulation(const PassRequest& passes, const Film& film);

  /// Different pixels may be added to at once.
  void add(std::size_t pixel, Vec3 radiance, float alpha) { sums_[pixel].add(radiance, alpha); }
  void add(std::size_t pixel, const PathRecord& record) { passes_.add(pixel, record); }

  /// The root of the mean squared error of the pixels of a tile, relative to them (squared, and
  /// 0.01 for what is dark), as the variance of their samples says: those of a sampler that
  /// stratifies are better than that.
  double error(const Film& film, const Tile& tile) const;

  void develop(Film& film) const;

  /// All of it, for a file; and back: false where it is of another image.
  std::string bytes() const;
  bool assign(std::string_view bytes);

 private:
  std::vector<PixelSum> sums_;
  PassSums passes_;
};

}  // namespace nacre::host
