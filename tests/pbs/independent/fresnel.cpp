#include "tests/pbs/independent/fresnel.h"

#include <algorithm>
#include <cmath>

namespace nacre::reference {

double fresnel(double cosine, std::complex<double> index) {
  const std::complex<double> squared = index * index;
  // The index beyond times the cosine there.
  const std::complex<double> beyond = std::sqrt(squared - (1.0 - cosine) * (1.0 + cosine));
  const std::complex<double> s = (cosine - beyond) / (cosine + beyond);
  const std::complex<double> p = (squared * cosine - beyond) / (squared * cosine + beyond);
  return 0.5 * (std::norm(s) + std::norm(p));
}

bool totally_reflected(double cosine, double index) {
  return (1.0 - cosine) * (1.0 + cosine) >= index * index;
}

double fresnel(double cosine, double index) {
  if (index == 1.0) return 0.0;
  if (totally_reflected(cosine, index)) return 1.0;
  const double beyond = std::sqrt(1.0 - (1.0 - cosine) * (1.0 + cosine) / (index * index));
  const double s = (cosine - index * beyond) / (cosine + index * beyond);
  const double p = (index * cosine - beyond) / (index * cosine + beyond);
  return 0.5 * (s * s + p * p);
}

double Schlick::at(double cosine) const {
  const auto plain = [&](double c) { return r0 + (r90 - r0) * std::pow(1.0 - c, exponent); };
  constexpr double c82 = 1.0 / 7.0;
  const double depth = plain(c82) * (1.0 - r82) / (c82 * std::pow(1.0 - c82, 6.0));
  return std::clamp(plain(cosine) - depth * cosine * std::pow(1.0 - cosine, 6.0), 0.0, 1.0);
}

double Schlick::index() const {
  const double root = std::sqrt(std::clamp(r0, 0.01, 0.99));
  return (1.0 + root) / (1.0 - root);
}

}  // namespace nacre::reference
