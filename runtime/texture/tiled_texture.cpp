#include "runtime/texture/tiled_texture.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace nacre {

/// The texels and weights of one axis: at most four, in the order of the filter.
struct TiledTexture::Taps {
  int count = 0;
  std::array<int, 4> texel{};
  std::array<float, 4> weight{};
};

/// See Footprint in sampling.h.
struct TiledTexture::Probes {
  int level = 0;
  float blend = 0.f;
  int count = 1;
  std::array<float, 2> reach{};  ///< In uv, to the ends of the line.
  float spread = 0.f;            ///< Weights are exp(-2 (spread p)^2).
};

namespace {

bool is_finite(float value) {
  return (std::bit_cast<std::uint32_t>(value) & 0x7f800000u) != 0x7f800000u;
}

/// A derivative of uv that counts; NaN stays.
float bounded(float d) { return d > 1024.f ? 1024.f : d < -1024.f ? -1024.f : d; }

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

TiledTexture::TiledTexture(std::shared_ptr<TileCache> cache, std::shared_ptr<TileCache::File> file,
                           const ImageInfo& info)
    : cache_(std::move(cache)),
      file_(std::move(file)),
      info_(info),
      levels_(TileCache::level_count(*file_)) {}

void TiledTexture::lookup(const TextureLookup& points, const std::array<float*, 4>& rgba) const {
  for (int lane = 0; lane < points.count; ++lane) {
    const Rgba value = sample(points, lane);
    for (std::size_t c = 0; c < 4; ++c) rgba[c][lane] = value[c];
  }
}

Rgba TiledTexture::sample(const TextureLookup& points, int lane) const {
  if (points.filter == TextureFilter::closest) {
    return filter_level(address(points.u[lane], points.u_mode),
                        address(points.v[lane], points.v_mode), 0, points);
  }
  const Probes probes = find_probes(points, lane);
  Rgba mean{};
  float sum = 0.f;
  for (int i = 0; i < probes.count; ++i) {
    const float p = (2.f * static_cast<float>(i) + 1.f) / static_cast<float>(probes.count) - 1.f;
    const float u = address(points.u[lane] + p * probes.reach[0], points.u_mode);
    const float v = address(points.v[lane] + p * probes.reach[1], points.v_mode);
    Rgba value = filter_level(u, v, probes.level, points);
    if (probes.blend > 0.f) {
      const Rgba coarse = filter_level(u, v, probes.level + 1, points);
      for (std::size_t c = 0; c < 4; ++c) value[c] += probes.blend * (coarse[c] - value[c]);
    }
    const float weight = std::exp(-2.f * p * p * probes.spread * probes.spread);
    sum += weight;
    for (std::size_t c = 0; c < 4; ++c) mean[c] += weight / sum * (value[c] - mean[c]);
  }
  return mean;
}

TiledTexture::Probes TiledTexture::find_probes(const TextureLookup& points, int lane) const {
  const auto width = static_cast<float>(info_.width);
  const auto height = static_cast<float>(info_.height);
  const auto texels = [&](const float* values, float size) {
    return bounded(at(values, lane)) * size;
  };
  const std::array<float, 2> x{texels(points.dudx, width), texels(points.dvdx, height)};
  const std::array<float, 2> y{texels(points.dudy, width), texels(points.dvdy, height)};
  const float c = x[0] * x[0] + y[0] * y[0];
  const float a = x[1] * x[1] + y[1] * y[1];
  const float b = x[0] * x[1] + y[0] * y[1];
  Probes probes;
  if (!(c + a > 9.f / 16.f)) return probes;  // Also NaN.
  const float root = std::hypot(c - a, 2.f * b);
  float major = std::sqrt(0.5f * (c + a + root));
  float minor = std::fabs(x[0] * y[1] - x[1] * y[0]) / major;
  const auto most = static_cast<float>(points.max_anisotropy);
  if (major > most * minor) {
    major = 0.5f * (major + most * minor);
    minor = major / most;
  }
  int exponent = 0;
  const float mantissa = std::frexp(std::max(minor, 1.f), &exponent);  // In [1/2, 1).
  probes.level = std::min(exponent - 1, levels_ - 1);
  if (exponent <= levels_ - 1) probes.blend = 2.f * mantissa - 1.f;
  const float aspect = std::clamp(major / std::max(minor, 0.5f), 1.f, most);
  probes.count = std::max(static_cast<int>(2.f * aspect - 1.f + 0x1p-10f), 1);
  const float length = major - minor;
  if (probes.count == 1) return probes;
  const float angle = 0.5f * std::atan2(2.f * b, c - a);
  probes.reach = {length * std::cos(angle) / width, length * std::sin(angle) / height};
  probes.spread = 0.5f * major / length;
  return probes;
}

Rgba TiledTexture::filter_level(float u, float v, int level, const TextureLookup& points) const {
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
Rgba TiledTexture::gather(const Taps& across, const Taps& up, int level) const {
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
void TiledTexture::read_texels(int level, int x0, int x1, int y0, int y1, Rgba* out) const {
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
