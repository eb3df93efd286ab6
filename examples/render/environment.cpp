#include "examples/render/environment.h"

#include <algorithm>
#include <cassert>
#include <numbers>
#include <utility>

namespace nacre::host {

namespace {

constexpr float pi = std::numbers::pi_v<float>;

Vec3 clean(Vec3 rgb) {
  const auto f = [](float v) { return std::isfinite(v) ? std::max(v, 0.f) : 0.f; };
  return {f(rgb.x), f(rgb.y), f(rgb.z)};
}

// Angles for where a direction is in an image need not be exact to the last bit, as the library's
// are.

/// In [0, pi], for x in [-1, 1]: Abramowitz and Stegun 1964, 4.4.46, off by at most 2e-8 before
/// rounding.
float arc_cosine(float x) {
  const float a = std::min(std::abs(x), 1.f);
  float sum = -0.0012624911f;
  for (const float c : {0.0066700901f, -0.0170881256f, 0.0308918810f, -0.0501743046f, 0.0889789874f,
                        -0.2145988016f, 1.5707963050f}) {
    sum = sum * a + c;
  }
  const float angle = std::sqrt(1.f - a) * sum;
  return x < 0.f ? pi - angle : angle;
}

/// In [-pi, pi]; 0 of zeros: Abramowitz and Stegun 1964, 4.4.49, off by at most 2e-8 before
/// rounding.
float arc_tangent(float y, float x) {
  const float ax = std::abs(x), ay = std::abs(y);
  const float larger = std::max(ax, ay);
  if (!(larger > 0.f)) return 0.f;
  const float ratio = std::min(ax, ay) / larger, square = ratio * ratio;
  float sum = 0.0028662257f;
  for (const float c : {-0.0161657367f, 0.0429096138f, -0.0752896400f, 0.1065626393f,
                        -0.1420889944f, 0.1999355085f, -0.3333314528f, 1.f}) {
    sum = sum * square + c;
  }
  float angle = sum * ratio;
  if (ay > ax) angle = 0.5f * pi - angle;
  if (x < 0.f) angle = pi - angle;
  return y < 0.f ? -angle : angle;
}

}  // namespace

Environment::Environment(int width, int height, std::vector<Vec3> texels, float rotation)
    : width_(width), height_(height), texels_(std::move(texels)), rotation_(rotation) {
  assert(width > 0 && height > 0);
  assert(texels_.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (Vec3& t : texels_) t = clean(t);
  build_tables();
}

Vec3 Environment::texel(int x, int y) const {
  const int wrapped = x < 0 ? x + width_ : (x >= width_ ? x - width_ : x);  // x in [-1, width]
  const int clamped = std::clamp(y, 0, height_ - 1);
  return texels_[static_cast<std::size_t>(clamped) * static_cast<std::size_t>(width_) +
                 static_cast<std::size_t>(wrapped)];
}

/// Between the latitudes of row y: (2π / width) (cos θ0 - cos θ1), as a product
/// because the difference cancels near the poles.
float Environment::texel_solid_angle(int y) const {
  const float step = pi / static_cast<float>(height_);
  const float middle = (static_cast<float>(y) + 0.5f) * step;
  return (2.f * pi / static_cast<float>(width_)) * 2.f * std::sin(middle) * std::sin(0.5f * step);
}

void Environment::build_tables() {
  const auto w = static_cast<std::size_t>(width_);
  std::vector<double> rows, columns(w);
  // The mean of a linear interpolation over its texel weighs neighbours 1:6:1 per axis.
  constexpr float share[3] = {0.125f, 0.75f, 0.125f};
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      float mean = 0.f;
      for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
          mean += share[i + 1] * share[j + 1] * luminance(texel(x + i, y + j));
        }
      }
      columns[static_cast<std::size_t>(x)] = mean;
    }
    columns_.emplace_back(columns);
    rows.push_back(columns_.back().sum() * texel_solid_angle(y));
  }
  rows_ = Distribution(rows);
  mean_ = static_cast<float>(rows_.sum() / (4 * std::numbers::pi));
  for (int y = 0; y <= height_; ++y) {
    latitudes_.push_back(std::cos(static_cast<float>(y) * pi / static_cast<float>(height_)));
    if (y < height_) row_densities_.push_back(rows_.probability(y) / texel_solid_angle(y));
  }
}

float Environment::texel_pdf(int x, int y) const {
  const auto row = static_cast<std::size_t>(y);
  return row_densities_[row] * columns_[row].probability(x);
}

/// At a position in texels, in [0, width) and [0, height).
Vec3 Environment::between_texels(Vec2 position) const {
  if (texels_.size() == 1) return texels_[0];  // To the bit.
  const Vec2 p = position - Vec2{0.5f, 0.5f};
  const float fx = std::floor(p.x), fy = std::floor(p.y);
  const int x = static_cast<int>(fx), y = static_cast<int>(fy);
  const float s = p.x - fx, t = p.y - fy;
  return (1.f - t) * ((1.f - s) * texel(x, y) + s * texel(x + 1, y)) +
         t * ((1.f - s) * texel(x, y + 1) + s * texel(x + 1, y + 1));
}

/// The position in rows, in [0, height), by the cosine to +y.
float Environment::row_at(float cosine) const {
  return std::min(arc_cosine(cosine) / pi, 0x1.fffffep-1f) * static_cast<float>(height_);
}

Environment::Light Environment::light(Vec3 direction) const {
  float u = 0.5f + (arc_tangent(direction.x, -direction.z) - rotation_) / (2.f * pi);
  u -= std::floor(u);
  const Vec2 p{std::min(u, 0x1.fffffep-1f) * static_cast<float>(width_), row_at(direction.y)};
  const int x = std::min(static_cast<int>(p.x), width_ - 1);
  const int y = std::min(static_cast<int>(p.y), height_ - 1);
  return {between_texels(p), texel_pdf(x, y)};
}

Environment::Sample Environment::sample(Uniform2 u) const {
  if (!(mean_ > 0.f)) return {};
  const auto [y, t] = rows_.choose(u.y);
  const auto [x, s] = columns_[static_cast<std::size_t>(y)].choose(u.x);
  // Even in solid angle: even in the cosine between the latitudes of the row.
  const auto row = static_cast<std::size_t>(y);
  const float height = latitudes_[row] + t * (latitudes_[row + 1] - latitudes_[row]);
  const float radius = std::sqrt(std::max(0.f, 1.f - height * height));
  const float column = static_cast<float>(x) + s;
  const float angle = 2.f * pi * (column / static_cast<float>(width_) - 0.5f) + rotation_;
  const Vec3 wi = {radius * std::sin(angle), height, -radius * std::cos(angle)};
  return {wi, between_texels({column, row_at(height)}), texel_pdf(x, y)};
}

Environment Environment::studio(float scale, float rotation) {
  constexpr int width = 512, height = 256;
  struct Box {
    float u, v, half_u, half_v;
    Vec3 radiance;
  };
  // Positions and sizes in image coordinates, v from the top.
  constexpr Box boxes[] = {{0.80f, 0.30f, 0.060f, 0.110f, {9.f, 8.8f, 8.4f}},
                           {0.22f, 0.34f, 0.080f, 0.080f, {3.2f, 3.4f, 3.8f}},
                           {0.50f, 0.22f, 0.018f, 0.170f, {5.f, 5.f, 5.f}}};
  const auto edge = [](float distance, float half) {  // one inside, fading over a fifth
    const float t = std::clamp((half - std::abs(distance)) / (0.2f * half), 0.f, 1.f);
    return t * t * (3.f - 2.f * t);
  };
  std::vector<Vec3> texels;
  texels.reserve(width * height);
  for (int y = 0; y < height; ++y) {
    const float v = (static_cast<float>(y) + 0.5f) / height;
    for (int x = 0; x < width; ++x) {
      const float u = (static_cast<float>(x) + 0.5f) / width;
      Vec3 rgb = (0.12f + 0.45f * std::max(0.f, 1.f - 1.6f * v)) * Vec3{0.96f, 0.98f, 1.f};
      for (const Box& b : boxes) {
        rgb += (edge(u - b.u, b.half_u) * edge(v - b.v, b.half_v)) * b.radiance;
      }
      texels.push_back(scale * rgb);
    }
  }
  return {width, height, std::move(texels), rotation};
}

}  // namespace nacre::host
