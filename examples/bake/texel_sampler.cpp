#include "examples/bake/texel_sampler.h"

#include <algorithm>
#include <cmath>

namespace nacre::host {

TexelSampler::TexelSampler(PointShader& shader, int count)
    : shader_(shader),
      places_(sample_places(count)),
      sums_(static_cast<std::size_t>(shader.components())) {
  points_.footprint = 1.0f / std::sqrt(static_cast<float>(count));
}

RunStatus TexelSampler::rows(int first, int rows, std::vector<std::vector<float>>& planes,
                             const std::atomic<std::uint32_t>& stop) {
  const int width = shader_.plane().width();
  const int strip_rows =
      std::clamp(static_cast<int>(shader_.points_of_a_run()) / width, 1, std::max(1, rows));
  for (std::vector<float>& plane : planes) {
    plane.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(width));
  }
  for (int begin = 0; begin < rows; begin += strip_rows) {
    const std::size_t at = static_cast<std::size_t>(begin) * static_cast<std::size_t>(width);
    const RunStatus status =
        strip(first + begin, std::min(strip_rows, rows - begin), planes, at, stop);
    if (status != RunStatus::done) return status;
  }
  return RunStatus::done;
}

RunStatus TexelSampler::strip(int first, int rows, std::vector<std::vector<float>>& planes,
                              std::size_t at, const std::atomic<std::uint32_t>& stop) {
  const int width = shader_.plane().width();
  const std::size_t count = static_cast<std::size_t>(rows) * static_cast<std::size_t>(width);
  for (std::vector<double>& sum : sums_) sum.assign(places_.size() == 1 ? 0 : count, 0.0);
  points_.x.resize(count);
  points_.y.resize(count);
  for (const SamplePlace& place : places_) {
    std::size_t next = 0;
    for (int j = first; j < first + rows; ++j) {
      for (int i = 0; i < width; ++i, ++next) {
        points_.x[next] = static_cast<float>(i) + place.x;
        points_.y[next] = static_cast<float>(j) + place.y;
      }
    }
    const RunStatus status = shader_.run(points_, stop);
    if (status != RunStatus::done) return status;
    for (std::size_t c = 0; c < planes.size(); ++c) {
      const std::vector<float>& result = shader_.result(c);
      if (places_.size() == 1) {
        std::copy(result.begin(), result.begin() + static_cast<std::ptrdiff_t>(count),
                  planes[c].begin() + static_cast<std::ptrdiff_t>(at));
        continue;
      }
      for (std::size_t i = 0; i < count; ++i) sums_[c][i] += static_cast<double>(result[i]);
    }
  }
  if (places_.size() == 1) return RunStatus::done;
  for (std::size_t c = 0; c < planes.size(); ++c) {
    for (std::size_t i = 0; i < count; ++i) {
      planes[c][at + i] = static_cast<float>(sums_[c][i] / static_cast<double>(places_.size()));
    }
  }
  return RunStatus::done;
}

}  // namespace nacre::host
