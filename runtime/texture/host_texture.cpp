#include "runtime/texture/host_texture.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace nacre {

/// The texels and weights of one axis: at most four, in the order of the filter.
struct HostTexture::Taps {
  int count = 0;
  std::array<int, 4> texel{};
  std::array<float, 4> weight{};
};

namespace {

bool is_finite(float value) {
  return (std::bit_cast<std::uint32_t>(value) & 0x7f800000u) != 0x7f800000u;
}

float at(const float* values, int lane) { return values ? values[lane] : 0.f; }

/// The coordinate in [0, 1] that an address mode makes of any float.
float address(float u, AddressMode mode) {
  if (!is_finite(u)) return 0.f;
  switch (mode) {
    case AddressMode::constant:
    case AddressMode::clamp: return std::clamp(u, 0.f, 1.f);
    case AddressMode::periodic: return u - std::floor(u);
    case AddressMode::mirror: {
      const float t = u - 2.f * std::floor(u * 0.5f);
      return t > 1.f ? 2.f - t : t;
    }
  }
  return 0.f;
}

int modulo(int value, int period) {
  const int remainder = value % period;
  return remainder < 0 ? remainder + period : remainder;
}

/// The texel a tap beyond the edge stands for.
int tap(int texel, int size, AddressMode mode) {
  switch (mode) {
    case AddressMode::constant:
    case AddressMode::clamp: return std::clamp(texel, 0, size - 1);
    case AddressMode::periodic: return modulo(texel, size);
    case AddressMode::mirror: {
      const int folded = modulo(texel, 2 * size);
      return folded < size ? folded : 2 * size - 1 - folded;
    }
  }
  return 0;
}

/// Uniform cubic B-spline: weights of texels -1, 0, 1, 2 at distance t from texel 0.
std::array<float, 4> b_spline(float t) {
  const float s = 1.f - t;
  const float first = s * s * s / 6.f;
  const float last = t * t * t / 6.f;
  const float second = 2.f / 3.f - 0.5f * t * t * (2.f - t);
  return {first, second, 1.f - first - second - last, last};
}

}  // namespace

HostTexture::HostTexture(std::shared_ptr<TileCache> cache, std::shared_ptr<TileCache::File> file,
                         const ImageInfo& info)
    : cache_(std::move(cache)),
      file_(std::move(file)),
      info_(info),
      levels_(TileCache::level_count(*file_)) {}

void HostTexture::lookup(const HostLookup& points, const std::array<float*, 4>& rgba) const {
  for (int lane = 0; lane < points.count; ++lane) {
    const Rgba value = sample(points, lane);
    for (std::size_t c = 0; c < 4; ++c) rgba[c][lane] = value[c];
  }
}

Rgba HostTexture::sample(const HostLookup& points, int lane) const {
  const float u = address(points.u[lane], points.u_mode);
  const float v = address(points.v[lane], points.v_mode);
  if (points.filter == TextureFilter::closest) return filter_level(u, v, 0, points);
  const float lambda = level_of_detail(points, lane);
  const int level = static_cast<int>(lambda);
  const float blend = lambda - static_cast<float>(level);
  Rgba value = filter_level(u, v, level, points);
  if (blend > 0.f) {
    const Rgba coarse = filter_level(u, v, level + 1, points);
    for (std::size_t c = 0; c < 4; ++c) value[c] += blend * (coarse[c] - value[c]);
  }
  return value;
}

float HostTexture::level_of_detail(const HostLookup& points, int lane) const {
  const auto width = static_cast<float>(info_.width);
  const auto height = static_cast<float>(info_.height);
  const float length_x = std::hypot(at(points.dudx, lane) * width, at(points.dvdx, lane) * height);
  const float length_y = std::hypot(at(points.dudy, lane) * width, at(points.dvdy, lane) * height);
  const float rho = std::max(length_x, length_y);
  if (!(rho > 1.f)) return 0.f;  // Also NaN.
  return std::min(std::log2(rho), static_cast<float>(levels_ - 1));
}

Rgba HostTexture::filter_level(float u, float v, int level, const HostLookup& points) const {
  const auto taps = [&](float coordinate, int size, AddressMode mode) {
    Taps result;
    const float scaled = coordinate * static_cast<float>(size);
    if (points.filter == TextureFilter::closest) {
      result.count = 1;
      result.texel[0] = std::min(static_cast<int>(scaled), size - 1);
      result.weight[0] = 1.f;
      return result;
    }
    const float x = scaled - 0.5f;
    const float floor = std::floor(x);
    const float t = x - floor;
    const bool cubic = points.filter == TextureFilter::cubic;
    result.count = cubic ? 4 : 2;
    result.weight = cubic ? b_spline(t) : std::array<float, 4>{1.f - t, t, 0.f, 0.f};
    const int first = static_cast<int>(floor) - (cubic ? 1 : 0);
    for (int k = 0; k < result.count; ++k) {
      result.texel[static_cast<std::size_t>(k)] = tap(first + k, size, mode);
    }
    return result;
  };
  return gather(taps(u, TileCache::width(*file_, level), points.u_mode),
                taps(v, TileCache::height(*file_, level), points.v_mode), level);
}

/// One read for the whole footprint when it is a rectangle of the image, which it is
/// everywhere but at a seam.
Rgba HostTexture::gather(const Taps& across, const Taps& up, int level) const {
  const auto count_x = static_cast<std::size_t>(across.count);
  const auto count_y = static_cast<std::size_t>(up.count);
  const auto consecutive = [](const Taps& taps, std::size_t count) {
    return taps.texel[count - 1] - taps.texel[0] == static_cast<int>(count) - 1 &&
           std::is_sorted(taps.texel.begin(), taps.texel.begin() + count);
  };
  std::array<Rgba, 16> texels;
  if (consecutive(across, count_x) && consecutive(up, count_y)) {
    read_texels(level, across.texel[0], across.texel[0] + across.count, up.texel[0],
                up.texel[0] + up.count, texels.data());
  } else {
    for (std::size_t j = 0; j < count_y; ++j) {
      for (std::size_t i = 0; i < count_x; ++i) {
        read_texels(level, across.texel[i], across.texel[i] + 1, up.texel[j], up.texel[j] + 1,
                    &texels[j * count_x + i]);
      }
    }
  }
  Rgba sum{};
  for (std::size_t j = 0; j < count_y; ++j) {
    for (std::size_t i = 0; i < count_x; ++i) {
      const float weight = across.weight[i] * up.weight[j];
      for (std::size_t c = 0; c < 4; ++c) sum[c] += weight * texels[j * count_x + i][c];
    }
  }
  return sum;
}

/// Rows counted from the bottom, as everywhere but in the file; `out` holds them upwards.
void HostTexture::read_texels(int level, int x0, int x1, int y0, int y1, Rgba* out) const {
  const int height = TileCache::height(*file_, level);
  const int columns = x1 - x0;
  const int rows = y1 - y0;
  const auto channels = static_cast<std::size_t>(info_.channels);
  std::array<float, 64> samples{};
  if (!cache_->read(*file_, level, x0, x1, height - y1, height - y0, samples.data())) {
    samples.fill(0.f);
    read_failures_.fetch_add(1, std::memory_order_relaxed);
  }
  std::uint64_t replaced = 0;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const auto from = static_cast<std::size_t>((rows - 1 - j) * columns + i) * channels;
      Rgba& texel = out[j * columns + i];
      texel = {0.f, 0.f, 0.f, 1.f};
      for (std::size_t c = 0; c < channels; ++c) texel[c] = sanitised(samples[from + c], replaced);
    }
  }
}

}  // namespace nacre
