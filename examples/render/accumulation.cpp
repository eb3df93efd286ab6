#include "examples/render/accumulation.h"

#include <cmath>

#include "examples/render/number_bytes.h"

namespace nacre::host {

Accumulation::Accumulation(const PassRequest& passes, const Film& film, const PixelWindow& window)
    : window_(window),
      sums_(window.pixels()),
      alphas_(film.has_alpha() ? window.pixels() : 0),
      passes_(passes, film.passes, window.pixels()) {}

double Accumulation::error(const Tile& tile, int samples) const {
  const auto relative = [](float variance, float mean) {
    const auto m = static_cast<double>(mean);
    return static_cast<double>(variance) / (m * m + 0.01);
  };
  double sum = 0;
  for_pixels(tile, [&](int x, int y) {
    const PixelSum& pixel = sums_[index(x, y)];
    const Vec3 variance = pixel.variance_of_mean(samples), mean = pixel.mean(samples);
    sum += (relative(variance.x, mean.x) + relative(variance.y, mean.y) +
            relative(variance.z, mean.z)) /
           3;
  });
  return std::sqrt(sum / static_cast<double>(tile.pixels()));
}

void Accumulation::develop(const std::vector<Tile>& tiles, const std::vector<int>& done,
                           Film& film) const {
  for (std::size_t k = 0; k < tiles.size(); ++k) {
    for_pixels(both(tiles[k], film.window()), [&](int x, int y) {
      const std::size_t i = index(x, y);
      film.mean(x, y) = sums_[i].mean(done[k]);
      film.variance(x, y) = sums_[i].variance_of_mean(done[k]);
      if (film.has_alpha()) film.set_alpha(x, y, static_cast<float>(alphas_[i] / done[k]));
      passes_.store(i, done[k], film.passes, film.index(x, y));
    });
  }
}

void Accumulation::append_to(std::string& bytes) const {
  append_numbers(bytes, sums_);
  append_numbers(bytes, alphas_);
  passes_.append_to(bytes);
}

bool Accumulation::assign(std::string_view bytes) {
  return take_numbers(bytes, sums_) && take_numbers(bytes, alphas_) && passes_.assign(bytes);
}

}  // namespace nacre::host
