#include "tests/pbs/independent/diffuse.h"

#include <algorithm>
#include <numbers>

namespace nacre::reference {

namespace {

constexpr double pi = std::numbers::pi;

/// r (E_Fujii(mu) - 1 / A) of the paper's albedo of the single-scattering lobe, which is
/// A + A r / pi times this.
double albedo_shape(double cosine) {
  const double sine = std::sqrt((1.0 - cosine) * (1.0 + cosine));
  const double steep = cosine > 0.0 ? sine / cosine * (1.0 - sine * sine * sine) : 0.0;
  return sine * (std::acos(cosine) - sine * cosine) + 2.0 / 3.0 * (steep - sine);
}

}  // namespace

Scattered lambert(double colour, Vec wi) {
  if (wi.z <= 0.0) return {};
  return {.f = colour / pi * wi.z, .pdf = wi.z / pi};
}

Scattered oren_nayar(double colour, double sigma, Vec wo, Vec wi) {
  if (wi.z <= 0.0) return {};
  const double sigma2 = sigma * sigma;
  const double a = 1.0 - 0.5 * sigma2 / (sigma2 + 0.33);
  const double b = 0.45 * sigma2 / (sigma2 + 0.09);
  const double theta_o = std::atan2(std::hypot(wo.x, wo.y), wo.z);
  const double theta_i = std::atan2(std::hypot(wi.x, wi.y), wi.z);
  const double turn = std::cos(std::atan2(wo.y, wo.x) - std::atan2(wi.y, wi.x));
  const double slanted = std::max(theta_o, theta_i), upright = std::min(theta_o, theta_i);
  const double rough = a + b * std::max(0.0, turn) * std::sin(slanted) * std::tan(upright);
  return {.f = colour / pi * rough * wi.z, .pdf = wi.z / pi};
}

Scattered energy_preserving_oren_nayar(double colour, double roughness, Vec wo, Vec wi) {
  if (wi.z <= 0.0) return {};
  const double a = 1.0 / (1.0 + (0.5 - 2.0 / (3.0 * pi)) * roughness);
  const double b = a * roughness;
  const double s = dot(wo, wi) - wo.z * wi.z;
  const double once = a + b * (s > 0.0 ? s / std::max(wo.z, wi.z) : s);
  double several = 0.0;
  if (roughness > 0.0) {
    const auto lost = [&](double cosine) { return 1.0 - (a + b / pi * albedo_shape(cosine)); };
    const double mean = a * (1.0 + (2.0 / 3.0 - 28.0 / (15.0 * pi)) * roughness);
    several = colour * colour * mean / (1.0 - colour * (1.0 - mean)) * lost(wo.z) * lost(wi.z) /
              (1.0 - mean);
  }
  return {.f = (colour * once + several) / pi * wi.z, .pdf = wi.z / pi};
}

Scattered burley(double colour, double roughness, Vec wo, Vec wi) {
  if (wi.z <= 0.0) return {};
  const double cos_d = dot(unit(wo + wi), wi);
  const double rise = 0.5 + 2.0 * roughness * cos_d * cos_d - 1.0;
  const auto slope = [&](double cosine) { return 1.0 + rise * std::pow(1.0 - cosine, 5.0); };
  return {.f = colour / pi * slope(wo.z) * slope(wi.z) * wi.z, .pdf = wi.z / pi};
}

}  // namespace nacre::reference
