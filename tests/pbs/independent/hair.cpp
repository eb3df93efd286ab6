#include "tests/pbs/independent/hair.h"

#include <algorithm>
#include <numbers>

#include "tests/pbs/independent/fresnel.h"

namespace nacre::reference {

namespace {

constexpr double pi = std::numbers::pi;

/// d'Eon et al. 2011, "An Energy-Conserving Hair Reflectance Model", eq. 7. Where the argument of
/// I0 is large, by its asymptotic series (DLMF 10.40.1), which is exact to 1e-9 there.
double longitudinal(double sin_i, double cos_i, double sin_o, double cos_o, double v) {
  const double x = cos_i * cos_o / v;
  const double b = sin_i * sin_o / v;
  if (x < 500.0) {
    const double log_i0 = std::log(std::cyl_bessel_i(0.0, x));
    return std::exp(log_i0 - b - 1.0 / v) / (v * -std::expm1(-2.0 / v));
  }
  double series = 1.0, term = 1.0;
  for (int k = 1; k < 8; ++k) series += term *= (2.0 * k - 1) * (2.0 * k - 1) / (8.0 * k * x);
  return series / std::sqrt(2.0 * pi * x) * std::exp(x - b - 1.0 / v) / v;
}

double logistic(double x, double s) {
  s *= std::sqrt(pi / 8.0);
  const auto below = [&](double y) { return 1.0 / (1.0 + std::exp(-y / s)); };
  const double e = std::exp(-std::abs(x) / s);
  return e / (s * (1.0 + e) * (1.0 + e)) / (below(pi) - below(-pi));
}

}  // namespace

Hair::Hair(const Fibre& fibre, Vec wo) : fibre_(fibre) {
  const double sin_o = wo.x, cos_o = std::hypot(wo.y, wo.z);
  const double outside = std::asin(-wo.y / cos_o);
  const double bent = std::sqrt(fibre.index * fibre.index - sin_o * sin_o) / cos_o;
  const double inside = std::asin(-wo.y / cos_o / bent);
  const double cos_t = std::sqrt(1.0 - sin_o * sin_o / (fibre.index * fibre.index));
  const double passed = std::exp(-fibre.absorption * 2.0 * std::cos(inside) / cos_t);
  const double reflected = fresnel(cos_o * std::cos(outside), fibre.index);
  const double once = (1.0 - reflected) * (1.0 - reflected) * passed;
  const double again = passed * reflected;
  const double shares[] = {reflected, once, once * again, once * again * again / (1.0 - again)};
  for (int p = 0; p < 4; ++p) {
    const double tilt = p == 3 ? 0.0 : (2.0 - 3.0 * p) * fibre.tilt;
    ways_[static_cast<std::size_t>(p)] = {
        .share = shares[p],
        .elevation = std::atan2(sin_o, cos_o) + tilt,
        .azimuth = std::atan2(wo.z, wo.y) + 2.0 * p * inside - 2.0 * outside + p * pi};
  }
}

double Hair::albedo() const {
  double sum = 0.0;
  for (const Way& way : ways_) sum += way.share;
  return sum;
}

Scattered Hair::at(Vec wi) const {
  const double sin_i = wi.x, cos_i = std::hypot(wi.y, wi.z);
  Scattered sum;
  for (std::size_t p = 0; p < ways_.size(); ++p) {
    const std::size_t as = std::min<std::size_t>(p, 2);
    const Way& way = ways_[p];
    const double m = longitudinal(sin_i, cos_i, std::sin(way.elevation),
                                  std::abs(std::cos(way.elevation)), fibre_.variance[as]);
    const double off = std::remainder(std::atan2(wi.z, wi.y) - way.azimuth, 2.0 * pi);
    const double n = p == 3 ? 0.5 / pi : logistic(off, fibre_.scale[as]);
    sum.f += way.share * m * n;
  }
  sum.pdf = sum.f / albedo();
  return sum;
}

}  // namespace nacre::reference
