#include "tests/pbs/independent/sheen.h"

#include <algorithm>
#include <numbers>

namespace nacre::reference {

namespace {

constexpr double pi = std::numbers::pi;

}  // namespace

FibreSheen::FibreSheen(double roughness, Vec wo) : roughness_(roughness), wo_(wo), scale_(1.0) {
  // By the root of the cosine, which is steep at grazing, and half the azimuths from the view's on.
  constexpr int rings = 200, azimuths = 100;
  const double azimuth = std::atan2(wo.y, wo.x);
  double all = 0.0;
  for (int i = 0; i < rings; ++i) {
    const double t = (i + 0.5) / rings;
    const double z = t * t, across = std::sqrt((1.0 - z) * (1.0 + z));
    for (int j = 0; j < azimuths; ++j) {
      const double phi = azimuth + pi * (j + 0.5) / azimuths;
      const Vec wi{across * std::cos(phi), across * std::sin(phi), z};
      all += once(wi) * 2.0 * t / rings * 2.0 * pi / azimuths;
    }
  }
  scale_ = 1.0 / std::max(all, 1.0);
  albedo_ = std::min(all, 1.0);
}

double FibreSheen::once(Vec wi) const {
  const Vec h = unit(wo_ + wi);
  const double sine = std::hypot(h.x, h.y);
  const double power = 1.0 / roughness_;
  const double d = (2.0 + power) * std::pow(sine, power) / (2.0 * pi);
  return d * wi.z / (4.0 * (wi.z + wo_.z - wi.z * wo_.z));
}

Scattered FibreSheen::at(Vec wi) const {
  if (wi.z <= 0.0) return {};
  return {.f = once(wi) * scale_, .pdf = 0.5 / pi};
}

TransformedSheen::TransformedSheen(double roughness, Vec wo) : wo_(wo) {
  const double x = wo.z, y = roughness;
  a_ = (2.58126 * x + 0.813703 * y) * y / (1.0 + 0.310327 * x * x + 2.60994 * x * y);
  b_ = std::sqrt(1.0 - x) * (y - 1.0) * y * y * y /
       (0.0000254053 + 1.71228 * x - 1.71506 * x * y + 1.34174 * y * y);
  const double s = y * (0.0206607 + 1.58491 * y) / (0.0379424 + y * (1.32227 + y));
  const double m =
      y * (-0.193854 + y * (-1.14885 + y * (1.7932 - 0.95943 * y * y))) / (0.046391 + y);
  const double o =
      y * (0.000654023 + (-0.0207818 + 0.119681 * y) * y) / (1.26264 + y * (-1.92021 + y));
  const double bell = std::exp(-0.5 * (x - m) * (x - m) / (s * s)) / (s * std::sqrt(2.0 * pi));
  albedo_ = std::clamp(bell + o, 0.0, 1.0);
}

Scattered TransformedSheen::at(Vec wi) const {
  if (wi.z <= 0.0) return {};
  // x along the view.
  const double length = std::hypot(wo_.x, wo_.y);
  const double cosine = length > 0.0 ? wo_.x / length : 1.0;
  const double sine = length > 0.0 ? wo_.y / length : 0.0;
  const double forth = cosine * wi.x + sine * wi.y, aside = cosine * wi.y - sine * wi.x;
  const Vec original{a_ * forth + b_ * wi.z, a_ * aside, wi.z};
  const double stretch = std::sqrt(dot(original, original));
  const double determinant = a_ * a_;
  const double pdf = original.z / stretch / pi * determinant / (stretch * stretch * stretch);
  return {.f = albedo_ * pdf, .pdf = pdf};
}

}  // namespace nacre::reference
