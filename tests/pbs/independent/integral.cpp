#include "tests/pbs/independent/integral.h"

#include <numbers>

namespace nacre::reference {

double integral(const std::function<Scattered(Vec wi)>& lobe) {
  // By the root of the cosine: at grazing things go fast.
  constexpr int rings = 400, azimuths = 200;
  double sum = 0.0;
  for (int i = 0; i < rings; ++i) {
    const double t = (i + 0.5) / rings;
    const double z = t * t, across = std::sqrt((1.0 - z) * (1.0 + z));
    for (int j = 0; j < azimuths; ++j) {
      const double phi = 2.0 * std::numbers::pi * (j + 0.5) / azimuths;
      sum += 2.0 * t * lobe({across * std::cos(phi), across * std::sin(phi), z}).f;
    }
  }
  return sum * 2.0 * std::numbers::pi / (rings * azimuths);
}

}  // namespace nacre::reference
