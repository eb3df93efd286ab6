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

/// Running sums of `weights`, scaled to end at exactly 1; all zero if they sum to 0.
double to_cdf(const std::vector<double>& weights, float* cdf) {
  double sum = 0;
  for (const double w : weights) sum += w;
  double running = 0;
  cdf[0] = 0.f;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    running += weights[i];
    cdf[i + 1] = sum > 0 ? static_cast<float>(running / sum) : 0.f;
  }
  if (sum > 0) cdf[weights.size()] = 1.f;
  return sum;
}

/// The interval of a cdf with n intervals that holds u, and where in it u is.
int find_interval(const float* cdf, int n, float u, float& within) {
  const float* above = std::upper_bound(cdf, cdf + n + 1, u);
  const int i = std::clamp(static_cast<int>(above - cdf) - 1, 0, n - 1);
  const float span = cdf[i + 1] - cdf[i];
  within = span > 0.f ? std::min((u - cdf[i]) / span, 0x1.fffffep-1f) : 0.5f;
  return i;
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
  const auto w = static_cast<std::size_t>(width_), h = static_cast<std::size_t>(height_);
  row_cdf_.resize(h + 1);
  column_cdf_.resize(h * (w + 1));
  std::vector<double> rows(h), columns(w);
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
    const auto row = static_cast<std::size_t>(y);
    rows[row] = to_cdf(columns, &column_cdf_[row * (w + 1)]) * texel_solid_angle(y);
  }
  mean_ = static_cast<float>(to_cdf(rows, row_cdf_.data()) / (4 * std::numbers::pi));
}

float Environment::texel_pdf(int x, int y) const {
  const std::size_t i = static_cast<std::size_t>(y) * (static_cast<std::size_t>(width_) + 1) +
                        static_cast<std::size_t>(x);
  const float row =
      row_cdf_[static_cast<std::size_t>(y) + 1] - row_cdf_[static_cast<std::size_t>(y)];
  return row * (column_cdf_[i + 1] - column_cdf_[i]) / texel_solid_angle(y);
}

namespace {

/// Image position in texels: x in [0, width), y in [0, height).
Vec2 to_image(Vec3 d, float rotation, int width, int height) {
  float u = 0.5f + (std::atan2(d.x, -d.z) - rotation) / (2.f * pi);
  u -= std::floor(u);
  const float v = 0.5f - std::asin(std::clamp(d.y, -1.f, 1.f)) / pi;
  return {std::min(u, 0x1.fffffep-1f) * static_cast<float>(width),
          std::clamp(v, 0.f, 0x1.fffffep-1f) * static_cast<float>(height)};
}

}  // namespace

Vec3 Environment::radiance(Vec3 direction) const {
  if (texels_.size() == 1) return texels_[0];
  const Vec2 p = to_image(direction, rotation_, width_, height_) - Vec2{0.5f, 0.5f};
  const float fx = std::floor(p.x), fy = std::floor(p.y);
  const int x = static_cast<int>(fx), y = static_cast<int>(fy);
  const float s = p.x - fx, t = p.y - fy;
  return (1.f - t) * ((1.f - s) * texel(x, y) + s * texel(x + 1, y)) +
         t * ((1.f - s) * texel(x, y + 1) + s * texel(x + 1, y + 1));
}

float Environment::pdf(Vec3 direction) const {
  const Vec2 p = to_image(direction, rotation_, width_, height_);
  return texel_pdf(std::min(static_cast<int>(p.x), width_ - 1),
                   std::min(static_cast<int>(p.y), height_ - 1));
}

Environment::Sample Environment::sample(Uniform2 u) const {
  if (!(mean_ > 0.f)) return {};
  float s = 0.f, t = 0.f;
  const int y = find_interval(row_cdf_.data(), height_, u.y, t);
  const int x = find_interval(
      &column_cdf_[static_cast<std::size_t>(y) * (static_cast<std::size_t>(width_) + 1)], width_,
      u.x, s);
  // Even in solid angle: even in the cosine between the latitudes of the row.
  const float step = pi / static_cast<float>(height_);
  const float above = std::cos(static_cast<float>(y) * step);
  const float below = std::cos(static_cast<float>(y + 1) * step);
  const float height = above + t * (below - above);
  const float radius = std::sqrt(std::max(0.f, 1.f - height * height));
  const float angle =
      2.f * pi * ((static_cast<float>(x) + s) / static_cast<float>(width_) - 0.5f) + rotation_;
  const Vec3 wi = {radius * std::sin(angle), height, -radius * std::cos(angle)};
  return {wi, radiance(wi), texel_pdf(x, y)};
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
