#include "examples/render/camera_paths.h"

#include <cmath>

namespace nacre::host {

namespace {

/// From the distribution even on [0, 1) to the tent on (-1, 1).
float tent(float u) {
  return u < 0.5f ? std::sqrt(2.f * u) - 1.f : 1.f - std::sqrt(2.f * (1.f - u));
}

}  // namespace

void CameraPaths::place_keys(const Tile& tile, int first, int last) {
  const RenderSettings& s = context_.settings;
  keys_.clear();
  for (int sample = first; sample < last; ++sample) {
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) {
        const auto pixel = static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(s.width) +
                           static_cast<std::uint32_t>(x);
        keys_.push_back({s.seed, pixel, static_cast<std::uint32_t>(sample), 0});
      }
    }
  }
}

void CameraPaths::draw(Draw what, std::vector<Uniform2>& numbers) const {
  numbers.resize(keys_.size());
  uniform2(context_.settings.sampler, keys_, what, numbers);
}

void CameraPaths::begin(const Tile& tile, int first, int last, std::vector<Path>& paths) {
  const RenderSettings& s = context_.settings;
  place_keys(tile, first, last);
  draw(Draw::pixel, places_);
  lenses_.assign(keys_.size(), {});
  times_.assign(keys_.size(), {});
  if (context_.camera.has_lens()) draw(Draw::lens, lenses_);
  if (is_open(s)) draw(Draw::time, times_);
  const bool is_box = s.filter == PixelFilter::box;
  const int width = tile.width(), pixels = static_cast<int>(tile.pixels());
  static const Path fresh;
  paths.resize(keys_.size());
  for (std::size_t k = 0; k < keys_.size(); ++k) {
    const int i = static_cast<int>(k) % pixels;
    const Uniform2 u = places_[k];
    const float x = static_cast<float>(tile.x0 + i % width) + (is_box ? u.x : 0.5f + tent(u.x));
    const float y = static_cast<float>(tile.y0 + i / width) + (is_box ? u.y : 0.5f + tent(u.y));
    const float time = times_[k].x;
    const PixelCamera::Ray ray = context_.camera.ray(x, y, lenses_[k], time);
    Path& path = paths[k];
    path = fresh;
    path.key = keys_[k];
    path.ray.origin = ray.origin;
    path.ray.direction = ray.direction;
    path.ray.far = INFINITY;
    path.ray.kind = ray_camera;
    path.ray.time = time;
    path.vertex = ray.origin;
    path.media = context_.camera_media;
  }
}

}  // namespace nacre::host
