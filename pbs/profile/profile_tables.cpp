#include "pbs/profile/profile_tables.h"

#include <array>
#include <cstddef>
#include <numbers>
#include <utility>

namespace nacre {

namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double longest_step = 10.0;

/// Gauss-Legendre on [0, 1], three points: Abramowitz and Stegun, table 25.4. Over steps of 10
/// degrees within 3e-7.
constexpr std::array<std::array<double, 2>, 3> points{{{0.1127016653792583, 0.2777777777777778},
                                                       {0.5, 0.4444444444444444},
                                                       {0.8872983346207417, 0.2777777777777778}}};

/// An angle of the tables between two that were measured.
struct Knot {
  std::size_t after = 0;  ///< The measured one before it, but the last.
  double fraction = 0.0;
  double angle = 0.0;
};

/// `kink`: an angle that is one of them, if it is among those measured.
std::vector<Knot> refine(const std::vector<float>& angles, double kink) {
  std::vector<Knot> knots;
  if (angles.size() == 1) return {{0, 0.0, angles.front()}};
  const auto add = [&](std::size_t after, double from, double to) {
    const double first = angles[after], size = angles[after + 1] - first;
    const int count = static_cast<int>(std::ceil((to - from) / longest_step - 1e-9));
    for (int i = 0; i < count; ++i) {
      const double angle = std::lerp(from, to, double(i) / count);
      knots.push_back({after, (angle - first) / size, angle});
    }
  };
  for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
    const double from = angles[i], to = angles[i + 1];
    const bool is_bent = from < kink && kink < to;
    if (is_bent) add(i, from, kink);
    add(i, is_bent ? kink : from, to);
  }
  knots.push_back({angles.size() - 2, 1.0, angles.back()});
  return knots;
}

/// The integral of what is linear from `first` to `last`, times a weight, between two angles.
template <class Weight>
double integral(double first, double last, double from, double to, Weight&& weight) {
  double sum = 0.0;
  for (const auto& [x, share] : points) {
    sum += share * std::lerp(first, last, x) * weight(std::lerp(from, to, x) * degree);
  }
  return sum * (to - from) * degree;
}

}  // namespace

Mirrors mirrors_of(const LightProfile& profile) {
  const float first = profile.horizontal.front(), last = profile.horizontal.back();
  if (profile.type != LightProfile::Type::c) {
    return {.x = first == 0.0f, .y = profile.vertical.front() == 0.0f};
  }
  const bool is_ring = profile.horizontal.size() == 1;
  return {.x = !is_ring && (first == 90.0f || last == 90.0f),
          .y = !is_ring && first == 0.0f && last <= 180.0f};
}

ProfileTables make_profile_tables(const LightProfile& profile) {
  const std::vector<Knot> vertical =
      refine(profile.vertical, profile.type == LightProfile::Type::c ? 90.0 : 360.0);
  const std::vector<Knot> horizontal = refine(profile.horizontal, 360.0);
  const bool is_ring = profile.horizontal.size() == 1;
  const auto along = [&](double angle) { return vertical_weight(profile.type, angle); };
  const auto across = [&](double angle) { return horizontal_weight(profile.type, angle); };
  ProfileTables tables;
  for (const Knot& v : vertical) tables.vertical.push_back(static_cast<float>(v.angle));
  double before = 0.0, last_all = 0.0;
  for (std::size_t j = 0; j < horizontal.size(); ++j) {
    const Knot& h = horizontal[j];
    const float* near = &profile.intensity[h.after * profile.vertical.size()];
    const float* far = is_ring ? near : near + profile.vertical.size();
    const auto at = [&](const Knot& v) {
      const double low = std::lerp(double(near[v.after]), double(far[v.after]), h.fraction);
      const double high =
          std::lerp(double(near[v.after + 1]), double(far[v.after + 1]), h.fraction);
      return std::lerp(low, high, v.fraction);
    };
    double below = 0.0;
    for (std::size_t i = 0; i < vertical.size(); ++i) {
      if (i > 0) {
        below += integral(at(vertical[i - 1]), at(vertical[i]), vertical[i - 1].angle,
                          vertical[i].angle, along);
      }
      tables.intensity.push_back(static_cast<float>(at(vertical[i])));
      tables.below.push_back(static_cast<float>(below));
    }
    if (j > 0) before += integral(last_all, below, horizontal[j - 1].angle, h.angle, across);
    last_all = below;
    tables.horizontal.push_back(static_cast<float>(h.angle));
    tables.before.push_back(static_cast<float>(before));
  }
  const Mirrors mirrors = mirrors_of(profile);
  tables.total = is_ring ? last_all * 2.0 * std::numbers::pi
                         : before * (mirrors.x ? 2.0 : 1.0) * (mirrors.y ? 2.0 : 1.0);
  return tables;
}

}  // namespace nacre
