#include "pbs/profile/light_profile.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace nacre {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// Gauss-Legendre on [0, 1], four points: Abramowitz and Stegun, table 25.4.
constexpr std::array<std::array<double, 2>, 4> points{{{0.0694318442029737, 0.1739274225687269},
                                                       {0.3300094782075719, 0.3260725774312731},
                                                       {0.6699905217924281, 0.3260725774312731},
                                                       {0.9305681557970263, 0.1739274225687269}}};

/// Solid angle by angles, times |z|.
double weight(LightProfile::Type type, double vertical, double horizontal) {
  if (type == LightProfile::Type::c) return std::sin(vertical) * std::abs(std::cos(vertical));
  const double latitude = type == LightProfile::Type::a ? vertical : horizontal;
  const double longitude = type == LightProfile::Type::a ? horizontal : vertical;
  return std::cos(latitude) * std::abs(std::cos(latitude) * std::cos(longitude));
}

/// How often what was measured is seen, all around.
double copies(const LightProfile& profile) {
  const float range = profile.horizontal.back() - profile.horizontal.front();
  if (profile.type == LightProfile::Type::c) return range > 0.0f ? 360.0 / range : 1.0;
  return (profile.horizontal.front() == 0.0f ? 2.0 : 1.0) *
         (profile.vertical.front() == 0.0f ? 2.0 : 1.0);
}

/// Four values, linear between them along both axes.
struct Cell {
  double from_v, size_v, from_h, size_h;
  std::array<double, 4> corners;  ///< The vertical angle is the faster.
  double at(double v, double h) const {
    const double x = (v - from_v) / size_v, y = (h - from_h) / size_h;
    return std::lerp(std::lerp(corners[0], corners[1], x), std::lerp(corners[2], corners[3], x), y);
  }
};

Cell cell(const LightProfile& profile, std::size_t v, std::size_t h) {
  const bool is_ring = profile.horizontal.size() == 1;
  const float* near = &profile.intensity[h * profile.vertical.size() + v];
  const float* far = is_ring ? near : near + profile.vertical.size();
  return {.from_v = profile.vertical[v],
          .size_v = profile.vertical[v + 1] - profile.vertical[v],
          .from_h = is_ring ? 0.0 : profile.horizontal[h],
          .size_h = is_ring ? 360.0 : profile.horizontal[h + 1] - profile.horizontal[h],
          .corners = {near[0], near[1], far[0], far[1]}};
}

/// Pieces so short that four points are exact to seven digits, none with the kink of |cos| inside.
std::vector<double> pieces(double from, double size) {
  std::vector<double> edges{from};
  for (const double end : {90.0, from + size}) {
    if (end <= edges.back() || end > from + size) continue;
    const double begin = edges.back();
    const int count = static_cast<int>(std::ceil((end - begin) / 30.0));
    for (int i = 1; i <= count; ++i) edges.push_back(std::lerp(begin, end, double(i) / count));
  }
  return edges;
}

double integral(LightProfile::Type type, const Cell& cell) {
  const std::vector<double> v = pieces(cell.from_v, cell.size_v);
  const std::vector<double> h = pieces(cell.from_h, cell.size_h);
  double sum = 0.0;
  for (std::size_t i = 1; i < v.size(); ++i) {
    for (std::size_t j = 1; j < h.size(); ++j) {
      for (const auto& [x, weight_x] : points) {
        for (const auto& [y, weight_y] : points) {
          const double at_v = std::lerp(v[i - 1], v[i], x), at_h = std::lerp(h[j - 1], h[j], y);
          sum += weight_x * weight_y * (v[i] - v[i - 1]) * (h[j] - h[j - 1]) * cell.at(at_v, at_h) *
                 weight(type, at_v * degree, at_h * degree);
        }
      }
    }
  }
  return sum * degree * degree;
}

}  // namespace

double emittance(const LightProfile& profile) {
  const std::size_t across = profile.horizontal.size() == 1 ? 1 : profile.horizontal.size() - 1;
  double sum = 0.0;
  for (std::size_t h = 0; h < across; ++h) {
    for (std::size_t v = 0; v + 1 < profile.vertical.size(); ++v) {
      sum += integral(profile.type, cell(profile, v, h));
    }
  }
  return sum * copies(profile);
}

}  // namespace nacre
