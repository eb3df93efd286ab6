#include "tests/runtime/texture/reference_sampler.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace nacre {

namespace {

double address(double u, AddressMode mode) {
  if (!std::isfinite(u)) return 0;
  if (mode == AddressMode::periodic) return u - std::floor(u);
  if (mode == AddressMode::mirror) {
    const double distance = std::fabs(u - 2 * std::round(u / 2));  // To the nearest even number.
    return distance;
  }
  return std::min(std::max(u, 0.0), 1.0);
}

/// Walks home step by step, so that it can be seen to be right.
int tap(int texel, int size, AddressMode mode) {
  while (texel < 0 || texel >= size) {
    if (mode == AddressMode::periodic) {
      texel += texel < 0 ? size : -size;
    } else if (mode == AddressMode::mirror) {
      texel = texel < 0 ? -1 - texel : 2 * size - 1 - texel;
    } else {
      texel = texel < 0 ? 0 : size - 1;
    }
  }
  return texel;
}

/// The weight of a texel whose centre is `distance` texels away.
double kernel(double distance, TextureFilter filter) {
  const double x = std::fabs(distance);
  if (filter == TextureFilter::linear) return x < 1 ? 1 - x : 0;
  if (x < 1) return 2.0 / 3.0 - x * x + x * x * x / 2;
  return x < 2 ? (2 - x) * (2 - x) * (2 - x) / 6 : 0;
}

double overlap(double a0, double a1, double b0, double b1) {
  return std::max(0.0, std::min(a1, b1) - std::max(a0, b0));
}

bool outside(double u, AddressMode mode) {
  return mode == AddressMode::constant && !(u >= 0 && u <= 1);
}

}  // namespace

std::optional<ReferenceSampler> ReferenceSampler::open(const std::string& path) {
  OIIO::ImageSpec options;
  options["oiio:UnassociatedAlpha"] = 1;
  auto input = OIIO::ImageInput::open(path, &options);
  if (!input) return std::nullopt;
  const OIIO::ImageSpec spec = input->spec();
  const int channels = std::min(spec.nchannels, 4);
  std::vector<double> samples(static_cast<std::size_t>(spec.width * spec.height * channels));
  if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::DOUBLE, samples.data())) {
    return std::nullopt;
  }
  Level level{spec.width, spec.height, {}};
  for (int y = spec.height - 1; y >= 0; --y) {
    for (int x = 0; x < spec.width; ++x) {
      Rgba64 texel{0, 0, 0, 1};
      for (int c = 0; c < channels; ++c) {
        const double value = samples[static_cast<std::size_t>((y * spec.width + x) * channels + c)];
        const bool kept = std::isfinite(value) && std::fabs(value) >= FLT_MIN;
        texel[static_cast<std::size_t>(c)] = kept ? value : 0;
      }
      level.texels.push_back(texel);
    }
  }
  ReferenceSampler result;
  result.pyramid_.push_back(level);
  while (level.width > 1 || level.height > 1) {
    level = halved(level);
    result.pyramid_.push_back(level);
  }
  return result;
}

/// Every texel against every coarser one: the share of its area is its weight.
ReferenceSampler::Level ReferenceSampler::halved(const Level& fine) {
  Level coarse{std::max(1, fine.width / 2), std::max(1, fine.height / 2), {}};
  const double step_x = static_cast<double>(fine.width) / coarse.width;
  const double step_y = static_cast<double>(fine.height) / coarse.height;
  for (int j = 0; j < coarse.height; ++j) {
    for (int i = 0; i < coarse.width; ++i) {
      Rgba64 sum{};
      for (int y = 2 * j; y < std::min(fine.height, 2 * j + 4); ++y) {
        for (int x = 2 * i; x < std::min(fine.width, 2 * i + 4); ++x) {
          const double area = overlap(x, x + 1, i * step_x, (i + 1) * step_x) *
                              overlap(y, y + 1, j * step_y, (j + 1) * step_y);
          const Rgba64& texel = fine.texels[static_cast<std::size_t>(y * fine.width + x)];
          for (std::size_t c = 0; c < 4; ++c) sum[c] += area * texel[c] / (step_x * step_y);
        }
      }
      coarse.texels.push_back(sum);
    }
  }
  return coarse;
}

const Rgba64& ReferenceSampler::texel(int level, int x, int y) const {
  const Level& in = pyramid_[static_cast<std::size_t>(level)];
  return in.texels[static_cast<std::size_t>(y * in.width + x)];
}

/// By turning the axes until they are longest: no formula for eigenvectors.
ReferenceSampler::Ellipse ReferenceSampler::ellipse(const ReferenceFootprint& footprint) const {
  const auto bounded = [](double d) { return std::min(std::max(d, -1024.0), 1024.0); };
  const double xu = bounded(footprint.dudx) * width(0);
  const double xv = bounded(footprint.dvdx) * height(0);
  const double yu = bounded(footprint.dudy) * width(0);
  const double yv = bounded(footprint.dvdy) * height(0);
  // What cos(s) X + sin(s) Y is; its length has one largest value for s in [0, pi).
  const auto point = [&](double s) {
    return std::array{std::cos(s) * xu + std::sin(s) * yu, std::cos(s) * xv + std::sin(s) * yv};
  };
  const auto length = [&](double s) { return std::hypot(point(s)[0], point(s)[1]); };
  const double pi = std::acos(-1.0);
  double best = 0;
  for (double s = 0; s < pi; s += pi / 64) {
    if (length(s) > length(best)) best = s;
  }
  double low = best - pi / 64;
  double high = best + pi / 64;
  for (int i = 0; i < 100; ++i) {
    const double left = low + (high - low) * 0.382;
    const double right = low + (high - low) * 0.618;
    (length(left) < length(right) ? low : high) = length(left) < length(right) ? left : right;
  }
  best = (low + high) / 2;
  return {length(best), length(best + pi / 2), std::atan2(point(best)[1], point(best)[0])};
}

Rgba64 ReferenceSampler::sample(double u, double v, const ReferenceFootprint& footprint,
                                const ReferenceModes& modes, const Rgba64& default_value) const {
  if (outside(u, modes.u) || outside(v, modes.v)) return default_value;
  if (modes.filter == TextureFilter::closest) {
    const int x = std::min(static_cast<int>(address(u, modes.u) * width(0)), width(0) - 1);
    const int y = std::min(static_cast<int>(address(v, modes.v) * height(0)), height(0) - 1);
    return texel(0, x, y);
  }
  Ellipse axes;
  const double sum = footprint.dudx + footprint.dvdx + footprint.dudy + footprint.dvdy;
  if (!std::isnan(sum)) axes = ellipse(footprint);
  double narrow = axes.minor;
  if (axes.major / axes.minor > modes.max_anisotropy) {
    axes.major = (axes.major + axes.minor * modes.max_anisotropy) / 2;
    narrow = axes.major / modes.max_anisotropy;
  }
  const double aspect = axes.major / std::max(narrow, 0.5);
  const int probes = std::max(
      1, static_cast<int>(2 * std::min<double>(aspect, modes.max_anisotropy) - 1 + 1.0 / 1024));
  if (probes == 1) return sample_levels(u, v, narrow, modes);
  Rgba64 result{};
  double weights = 0;
  for (int i = 0; i < probes; ++i) {
    const double p = (2.0 * i + 1) / probes - 1;
    const double way = p * (axes.major - narrow);
    const double x = p * axes.major / (2 * (axes.major - narrow));
    const double weight = std::exp(-2 * x * x);
    const Rgba64 value = sample_levels(u + way * std::cos(axes.angle) / width(0),
                                       v + way * std::sin(axes.angle) / height(0), narrow, modes);
    weights += weight;
    for (std::size_t c = 0; c < 4; ++c) result[c] += weight * value[c];
  }
  for (double& component : result) component /= weights;
  return result;
}

Rgba64 ReferenceSampler::sample_levels(double u, double v, double narrow,
                                       const ReferenceModes& modes) const {
  u = address(u, modes.u);
  v = address(v, modes.v);
  int level = 0;
  while (level + 1 < levels() && narrow >= 2) {
    narrow /= 2;
    ++level;
  }
  const Rgba64 near = sample_level(u, v, level, modes);
  if (narrow <= 1 || level + 1 == levels()) return near;
  const Rgba64 far = sample_level(u, v, level + 1, modes);
  Rgba64 result;
  for (std::size_t c = 0; c < 4; ++c) result[c] = (2 - narrow) * near[c] + (narrow - 1) * far[c];
  return result;
}

Rgba64 ReferenceSampler::sample_level(double u, double v, int level,
                                      const ReferenceModes& modes) const {
  const double x = u * width(level);
  const double y = v * height(level);
  Rgba64 sum{};
  for (int j = static_cast<int>(y) - 3; j <= static_cast<int>(y) + 3; ++j) {
    for (int i = static_cast<int>(x) - 3; i <= static_cast<int>(x) + 3; ++i) {
      const double weight =
          kernel(x - (i + 0.5), modes.filter) * kernel(y - (j + 0.5), modes.filter);
      if (weight == 0) continue;
      const Rgba64& value =
          texel(level, tap(i, width(level), modes.u), tap(j, height(level), modes.v));
      for (std::size_t c = 0; c < 4; ++c) sum[c] += weight * value[c];
    }
  }
  return sum;
}

}  // namespace nacre
