#include "examples/render/accumulation.h"

#include <cmath>
#include <cstring>
#include <type_traits>

namespace nacre::host {

Accumulation::Accumulation(const PassRequest& passes, const Film& film)
    : sums_(film.pixels().size()), passes_(passes, film.passes, film.pixels().size()) {}

double Accumulation::error(const Film& film, const Tile& tile) const {
  const auto relative = [](float variance, float mean) {
    return static_cast<double>(variance) /
           (static_cast<double>(mean) * static_cast<double>(mean) + 0.01);
  };
  double sum = 0;
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; ++x) {
      const PixelSum& pixel = sums_[film.index(x, y)];
      const Vec3 variance = pixel.variance_of_mean(), mean = pixel.mean();
      sum += (relative(variance.x, mean.x) + relative(variance.y, mean.y) +
              relative(variance.z, mean.z)) /
             3;
    }
  }
  return std::sqrt(sum / tile.pixels());
}

void Accumulation::develop(Film& film) const {
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x) {
      const std::size_t i = film.index(x, y);
      film.mean(x, y) = sums_[i].mean();
      film.variance(x, y) = sums_[i].variance_of_mean();
      if (film.has_alpha()) film.set_alpha(x, y, sums_[i].alpha());
      passes_.store(i, i, film.passes);
    }
  }
}

std::string Accumulation::bytes() const {
  static_assert(std::is_trivially_copyable_v<PixelSum>);
  std::string bytes(sums_.size() * sizeof(PixelSum), '\0');
  std::memcpy(bytes.data(), sums_.data(), bytes.size());
  passes_.append_to(bytes);
  return bytes;
}

bool Accumulation::assign(std::string_view bytes) {
  const std::size_t size = sums_.size() * sizeof(PixelSum);
  if (bytes.size() < size) return false;
  std::memcpy(sums_.data(), bytes.data(), size);
  return passes_.assign(bytes.substr(size));
}

}  // namespace nacre::host
