#include "examples/render/motion.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <utility>

namespace nacre::host {

namespace {

bool same(Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

bool same(const Affine& a, const Affine& b) {
  return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z) && same(a.origin, b.origin);
}

Vec3 mix(Vec3 a, Vec3 b, float f) { return (1.f - f) * a + f * b; }

Affine mix(const Affine& a, const Affine& b, float f) {
  return {mix(a.x, b.x, f), mix(a.y, b.y, f), mix(a.z, b.z, f), mix(a.origin, b.origin, f)};
}

/// The segment that is there in the middle of a piece of time.
const Motion::Segment& segment_at(const Motion& motion, float time) {
  const auto& all = motion.segments();
  const auto behind = std::ranges::upper_bound(all, time, {}, &Motion::Segment::begin);
  return behind == all.begin() ? all.front() : *std::prev(behind);
}

int steps_at(const Motion& motion, float time) {
  return motion.is_still() ? 0 : static_cast<int>(segment_at(motion, time).steps.size()) - 1;
}

Affine map_at(const Motion& motion, float middle, float time) {
  return motion.is_still() ? motion.still() : at(segment_at(motion, middle), time);
}

/// The product of two that move is no straight line.
constexpr int least_steps_of_both = 16;

/// Whether the determinant, a cubic along the step, has one sign: its Bernstein coefficients,
/// from four of its values, have.
bool keeps_its_sign(const Affine& a, const Affine& b) {
  double d[4];
  for (int i = 0; i < 4; ++i) {
    d[i] = static_cast<double>(determinant(mix(a, b, static_cast<float>(i) / 3.f)));
    if (!std::isfinite(d[i])) return false;
  }
  const double middle[2] = {(-5 * d[0] + 18 * d[1] - 9 * d[2] + 2 * d[3]) / 6,
                            (2 * d[0] - 9 * d[1] + 18 * d[2] - 5 * d[3]) / 6};
  const double sign = d[0] < 0 ? -1 : 1;
  // Of what shrinks to nearly nothing, these are as small as their rounding.
  const double rounding = 1e-6 * std::max(std::abs(d[0]), std::abs(d[3]));
  return sign * d[0] > 0 && sign * d[3] > 0 && sign * middle[0] > -rounding &&
         sign * middle[1] > -rounding;
}

bool has_inverse(const Affine& m) {
  const float d = determinant(m);
  return std::isfinite(d) && std::isfinite(1.f / d);
}

}  // namespace

Motion::Motion(std::vector<Segment> segments) : segments_(std::move(segments)) {
  assert(!segments_.empty());
  const Affine first = segments_.front().steps.front();
  const bool stays = std::ranges::all_of(segments_, [&](const Segment& segment) {
    return std::ranges::all_of(segment.steps, [&](const Affine& m) { return same(m, first); });
  });
  if (!stays) return;
  still_ = first;
  segments_.clear();
}

std::size_t Motion::steps() const {
  std::size_t sum = 0;
  for (const Segment& segment : segments_) sum += segment.steps.size();
  return std::max<std::size_t>(sum, 1);
}

Affine Motion::at(float time) const {
  return is_still() ? still_ : host::at(segment_at(*this, time), time);
}

Affine at(const Motion::Segment& s, float time) {
  const auto pieces = static_cast<float>(s.steps.size() - 1);
  const float place = (time - s.begin) / (s.end - s.begin) * pieces;
  const float whole = std::clamp(std::floor(place), 0.f, pieces - 1.f);
  const auto i = static_cast<std::size_t>(whole);
  return mix(s.steps[i], s.steps[i + 1], place - whole);
}

int steps_for_angle(double radians) {
  constexpr double chord = 0.05;  // 1 - cos(0.05 / 2) is 1/3200.
  const double wanted = std::ceil(std::abs(radians) / chord);
  if (!(wanted < Motion::most_steps)) return Motion::most_steps;
  return static_cast<int>(std::bit_ceil(std::max(1u, static_cast<unsigned>(wanted))));
}

std::size_t steps_of_product(const Motion& outer, const Motion& inner) {
  if (outer.is_still() && inner.is_still()) return 1;
  const std::size_t segments = outer.segments().size() + inner.segments().size();
  int most = least_steps_of_both;
  for (const Motion* each : {&outer, &inner}) {
    for (const auto& s : each->segments()) {
      most = std::max(most, static_cast<int>(s.steps.size()));
    }
  }
  return segments * (static_cast<std::size_t>(most) + 1);
}

Motion operator*(const Motion& outer, const Motion& inner) {
  if (outer.is_still() && inner.is_still()) return Motion(outer.still() * inner.still());
  std::vector<float> bounds = {1.f};
  for (const Motion* each : {&outer, &inner}) {
    for (const auto& s : each->segments()) bounds.push_back(s.begin);
  }
  std::ranges::sort(bounds);
  const auto same = [](float a, float b) { return b - a < Motion::shortest; };
  bounds.erase(std::unique(bounds.begin(), bounds.end(), same), bounds.end());
  bounds.back() = 1.f;
  std::vector<Motion::Segment> segments;
  for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
    Motion::Segment s{bounds[i], bounds[i + 1], {}};
    const float middle = 0.5f * (s.begin + s.end);
    int steps = std::max({steps_at(outer, middle), steps_at(inner, middle), 1});
    const bool both = !outer.is_still() && !inner.is_still();
    if (both) steps = std::max(steps, least_steps_of_both);
    for (int k = 0; k <= steps; ++k) {
      const float share = static_cast<float>(k) / static_cast<float>(steps);
      const float time = (1.f - share) * s.begin + share * s.end;
      s.steps.push_back(map_at(outer, middle, time) * map_at(inner, middle, time));
    }
    segments.push_back(std::move(s));
  }
  return Motion(std::move(segments));
}

bool is_invertible(const Motion& motion) {
  if (motion.is_still()) return has_inverse(motion.still());
  for (const auto& s : motion.segments()) {
    if (!std::ranges::all_of(s.steps, has_inverse)) return false;
    for (std::size_t i = 0; i + 1 < s.steps.size(); ++i) {
      if (!keeps_its_sign(s.steps[i], s.steps[i + 1])) return false;
    }
  }
  return true;
}

void for_each_step(const Motion& motion, const std::function<void(const Affine&)>& f) {
  if (motion.is_still()) return f(motion.still());
  for (const auto& s : motion.segments()) std::ranges::for_each(s.steps, f);
}

}  // namespace nacre::host
