#pragma once

#include <cmath>

#include "examples/render/film.h"

namespace nacre::host {

/// Mean over a rectangle of a film and the variance of that mean, for one
/// channel. The pixels have to be independent.
struct Estimate {
  double mean = 0, variance = 0;
};

inline Estimate estimate(const Film& film, int channel, int x0, int y0, int x1, int y1) {
  Estimate e;
  const auto pick = [channel](Vec3 v) { return channel == 0 ? v.x : channel == 1 ? v.y : v.z; };
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      e.mean += pick(film.mean(x, y));
      e.variance += pick(film.variance(x, y));
    }
  }
  const double n = double(x1 - x0) * (y1 - y0);
  return {e.mean / n, e.variance / (n * n)};
}

inline Estimate estimate(const Film& film, int channel) {
  return estimate(film, channel, 0, 0, film.width(), film.height());
}

/// Standard deviations between two estimates.
inline double z_score(Estimate a, Estimate b) {
  const double difference = std::abs(a.mean - b.mean);
  return difference == 0 ? 0 : difference / std::sqrt(a.variance + b.variance);
}

inline double z_score(Estimate a, double exact) { return z_score(a, {exact, 0}); }

}  // namespace nacre::host
