#include "examples/render/environment.h"

#include <algorithm>
#include <cassert>
#include <numbers>
#include <utility>

namespace nacre::host {

namespace {

constexpr float pi = std::numbers::pi_v<float>;
/// Of a texel: while tables are built its mean luminance, then the chance to be drawn.
constexpr int weight = 3;
/// Of the light, above its mean: less is as good as even, and is drawn whole.
constexpr double least_excess = 0.02;

Vec3 clean(Vec3 rgb) {
  const auto f = [](float v) { return std::isfinite(v) ? std::max(v, 0.f) : 0.f; };
  return {f(rgb.x), f(rgb.y), f(rgb.z)};
}

}  // namespace

Environment::Environment(int width, int height, const std::vector<Vec3>& texels, float rotation,
                         Drawn drawn)
    : width_(width), height_(height), map_(width, height, rotation) {
  assert(width > 0 && height > 0);
  assert(texels.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  texels_.reserve(static_cast<std::size_t>(width + 2) * static_cast<std::size_t>(height + 2));
  for (int y = -1; y <= height; ++y) {
    for (int x = -1; x <= width; ++x) {
      const int column = (x + width) % width, row = std::clamp(y, 0, height - 1);
      const Vec3 rgb =
          clean(texels[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                       static_cast<std::size_t>(column)]);
      texels_.push_back(Texel{rgb.x, rgb.y, rgb.z, 0.f});
    }
  }
  build_tables(drawn);
}

/// The number of a texel; the image goes on for one to each side.
std::size_t Environment::at(int x, int y) const {
  return static_cast<std::size_t>(y + 1) * static_cast<std::size_t>(width_ + 2) +
         static_cast<std::size_t>(x + 1);
}

Vec3 Environment::radiance(int x, int y) const {
  const Texel& t = texels_[at(x, y)];
  return {t[0], t[1], t[2]};
}

/// Between the latitudes of row y: (2π / width) (cos θ0 - cos θ1), as a product
/// because the difference cancels near the poles.
float Environment::texel_solid_angle(int y) const {
  const float step = pi / static_cast<float>(height_);
  const float middle = (static_cast<float>(y) + 0.5f) * step;
  return (2.f * pi / static_cast<float>(width_)) * 2.f * std::sin(middle) * std::sin(0.5f * step);
}

void Environment::build_tables(Drawn drawn) {
  const double all = find_weights();
  mean_ = static_cast<float>(all / (4 * std::numbers::pi));
  draws_all_ = drawn == Drawn::all || excess(mean_) <= least_excess * all;
  const float dim = draws_all_ ? 0.f : mean_;
  std::vector<double> rows, columns(static_cast<std::size_t>(width_));
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      columns[static_cast<std::size_t>(x)] = std::max(0.f, texels_[at(x, y)][weight] - dim);
    }
    columns_.emplace_back(columns);
    for (int x = 0; x < width_; ++x) texels_[at(x, y)][weight] = columns_.back().probability(x);
    rows.push_back(columns_.back().sum() * texel_solid_angle(y));
  }
  rows_ = Distribution(rows);
  for (int y = 0; y <= height_; ++y) {
    latitudes_.push_back(std::cos(static_cast<float>(y) * pi / static_cast<float>(height_)));
    if (y < height_) row_densities_.push_back(rows_.probability(y) / texel_solid_angle(y));
  }
}

/// Gives each texel its mean luminance, and returns the integral over the sphere. The mean of a
/// linear interpolation over its texel weighs neighbours 1:6:1 per axis.
double Environment::find_weights() {
  constexpr float share[3] = {0.125f, 0.75f, 0.125f};
  double all = 0;
  for (int y = 0; y < height_; ++y) {
    double row = 0;
    for (int x = 0; x < width_; ++x) {
      float mean = 0.f;
      for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
          mean += share[i + 1] * share[j + 1] * luminance(radiance(x + i, y + j));
        }
      }
      texels_[at(x, y)][weight] = mean;
      row += mean;
    }
    all += row * texel_solid_angle(y);
  }
  return all;
}

/// The integral over the sphere of what is above `dim`.
double Environment::excess(float dim) const {
  double all = 0;
  for (int y = 0; y < height_; ++y) {
    double row = 0;
    for (int x = 0; x < width_; ++x) row += std::max(0.f, texels_[at(x, y)][weight] - dim);
    all += row * texel_solid_angle(y);
  }
  return all;
}

float Environment::texel_pdf(int x, int y) const {
  return row_densities_[static_cast<std::size_t>(y)] * texels_[at(x, y)][weight];
}

/// The first of the four texels around a position, in [0, width) and [0, height).
Environment::Corner Environment::corner(Vec2 position) const {
  const Vec2 p = position - Vec2{0.5f, 0.5f};
  // Towards zero is down, from -1 on.
  const float x = static_cast<float>(static_cast<int>(p.x + 1.f) - 1);
  const float y = static_cast<float>(static_cast<int>(p.y + 1.f) - 1);
  return {at(static_cast<int>(x), static_cast<int>(y)), p.x - x, p.y - y};
}

/// What between_texels() reads there; most of the time all of it.
void Environment::fetch(Vec2 position) const {
  const Corner c = corner(position);
  __builtin_prefetch(&texels_[c.first]);
  __builtin_prefetch(&texels_[c.first + static_cast<std::size_t>(width_ + 3)]);
}

Vec3 Environment::between_texels(Vec2 position) const {
  if (width_ * height_ == 1) return radiance(0, 0);  // To the bit.
  const Corner corner = this->corner(position);
  const Texel* const row = texels_.data() + corner.first;
  const Texel* const next = row + width_ + 2;
  const float s = corner.s, t = corner.t;
  const Texel sum =
      (1.f - t) * ((1.f - s) * row[0] + s * row[1]) + t * ((1.f - s) * next[0] + s * next[1]);
  return {sum[0], sum[1], sum[2]};
}

Environment::Light Environment::light_at(Vec2 position) const {
  const int x = std::min(static_cast<int>(position.x), width_ - 1);
  const int y = std::min(static_cast<int>(position.y), height_ - 1);
  return {between_texels(position), texel_pdf(x, y)};
}

Environment::Light Environment::light(Vec3 direction) const {
  Light found;
  light({&direction, 1}, {&found, 1});
  return found;
}

Environment::Sample Environment::sample(Uniform2 u) const {
  Sample drawn;
  sample({&u, 1}, {&drawn, 1});
  return drawn;
}

void Environment::light(std::span<const Vec3> directions, std::span<Light> lights) const {
  assert(directions.size() == lights.size());
  Vec2 positions[SkyMap::block_size];
  for (std::size_t first = 0; first < directions.size(); first += SkyMap::block_size) {
    const std::size_t count = std::min(SkyMap::block_size, directions.size() - first);
    map_.positions_of(directions.data() + first, count, positions);
    for (std::size_t i = 0; i < count; ++i) fetch(positions[i]);
    for (std::size_t i = 0; i < count; ++i) lights[first + i] = light_at(positions[i]);
  }
}

void Environment::sample(std::span<const Uniform2> u, std::span<Sample> samples) const {
  assert(u.size() == samples.size());
  if (!(mean_ > 0.f)) {
    std::ranges::fill(samples, Sample{});
    return;
  }
  for (std::size_t first = 0; first < u.size(); first += SkyMap::block_size) {
    const std::size_t count = std::min(SkyMap::block_size, u.size() - first);
    sample_block(u.subspan(first, count), samples.data() + first);
  }
}

void Environment::sample_block(std::span<const Uniform2> u, Sample* samples) const {
  Distribution::Choice rows[SkyMap::block_size];
  SkyMap::Place places[SkyMap::block_size] = {};
  float densities[SkyMap::block_size];
  Vec3 directions[SkyMap::block_size];
  Vec2 positions[SkyMap::block_size];
  const auto row = [&](std::size_t i) { return static_cast<std::size_t>(rows[i].interval); };
  for (std::size_t i = 0; i < u.size(); ++i) {
    rows[i] = rows_.choose(u[i].y);
    columns_[row(i)].fetch_guide(u[i].x);
  }
  for (std::size_t i = 0; i < u.size(); ++i) columns_[row(i)].fetch_edges(u[i].x);
  for (std::size_t i = 0; i < u.size(); ++i) {
    const auto [x, within] = columns_[row(i)].choose(u[i].x);
    densities[i] = row_densities_[row(i)] * columns_[row(i)].probability(x);
    // Even in solid angle: even in the cosine between the latitudes of the row.
    const float top = latitudes_[row(i)], bottom = latitudes_[row(i) + 1];
    places[i] = {static_cast<float>(x) + within, top + rows[i].within * (bottom - top)};
  }
  map_.directions_to(places, u.size(), directions, positions);
  for (std::size_t i = 0; i < u.size(); ++i) fetch(positions[i]);
  for (std::size_t i = 0; i < u.size(); ++i) {
    samples[i] = {directions[i], between_texels(positions[i]), densities[i]};
  }
}

Environment Environment::studio(float scale, float rotation, Drawn drawn) {
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
  return {width, height, texels, rotation, drawn};
}

}  // namespace nacre::host
