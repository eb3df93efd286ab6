#include "examples/bake/texel_sampler.h"

#include <algorithm>
#include <cmath>

namespace nacre::host {

TexelSampler::TexelSampler(PointShader& shader, int count)
    : shader_(shader),
      places_(sample_places(count)),
      sums_(static_cast<std::size_t>(shader.components())),
      beside_(sums_.size()) {
  points_.footprint = 1.0f / std::sqrt(static_cast<float>(count));
}

RunStatus TexelSampler::rows(int first, int rows, std::vector<std::vector<float>>& planes,
                             const std::atomic<std::uint32_t>& stop, BakeCounts& counts) {
  const auto width = static_cast<std::size_t>(shader_.width());
  const std::size_t begin = static_cast<std::size_t>(first) * width;
  const std::size_t all = static_cast<std::size_t>(rows) * width;
  shader_.enter(first, rows);
  list_texels(begin, all);
  for (std::vector<float>& plane : planes) plane.assign(all, 0.0f);
  const std::size_t step = std::max(shader_.points_of_a_run() / width * width, width);
  for (std::size_t i = 0; i < texels_.size(); i += step) {
    const RunStatus status = strip(i, std::min(step, texels_.size() - i), begin, planes, stop);
    if (status != RunStatus::done) return status;
  }
  counts.samples += texels_.size() * places_.size();
  return RunStatus::done;
}

/// Of whole rows those that are covered.
void TexelSampler::list_texels(std::size_t begin, std::size_t all) {
  const auto width = static_cast<std::size_t>(shader_.width());
  texels_.resize(all);
  columns_.resize(all);
  rows_.resize(all);
  std::size_t count = 0;
  for (std::size_t i = begin; i < begin + all; i += width) {
    const auto row = static_cast<float>(i / width);
    for (std::size_t column = 0; column < width; ++column) {
      if (!shader_.covers(i + column)) continue;
      texels_[count] = i + column;
      columns_[count] = static_cast<float>(column);
      rows_[count] = row;
      ++count;
    }
  }
  texels_.resize(count);
  columns_.resize(count);
  rows_.resize(count);
}

RunStatus TexelSampler::strip(std::size_t begin, std::size_t count, std::size_t first,
                              std::vector<std::vector<float>>& planes,
                              const std::atomic<std::uint32_t>& stop) {
  const bool is_mean = places_.size() > 1;
  // One after the other: nothing of the rows is left out.
  const bool is_dense = texels_[begin + count - 1] - texels_[begin] == count - 1;
  for (std::vector<double>& sum : sums_) sum.assign(is_mean ? count : 0, 0.0);
  for (std::vector<float>& values : beside_) values.resize(is_mean ? count : 0);
  hits_.assign(is_mean ? count : 0, 0);
  points_.x.resize(count);
  points_.y.resize(count);
  points_.texel.assign(texels_.begin() + static_cast<std::ptrdiff_t>(begin),
                       texels_.begin() + static_cast<std::ptrdiff_t>(begin + count));
  for (const SamplePlace& place : places_) {
    for (std::size_t i = 0; i < count; ++i) {
      points_.x[i] = columns_[begin + i] + place.x;
      points_.y[i] = rows_[begin + i] + place.y;
    }
    const RunStatus status = shader_.run(points_, stop);
    if (status != RunStatus::done) return status;
    if (is_mean) add_samples(count);
  }
  for (std::size_t c = 0; c < planes.size(); ++c) {
    const std::vector<float>& last = shader_.result(c);
    if (!is_mean && is_dense) {
      std::copy_n(last.begin(), count,
                  planes[c].begin() + static_cast<std::ptrdiff_t>(points_.texel[0] - first));
      continue;
    }
    for (std::size_t i = 0; i < count; ++i) {
      float& texel = planes[c][points_.texel[i] - first];
      if (!is_mean) {
        texel = last[i];
      } else if (hits_[i] == 0) {
        texel = beside_[c][i];
      } else {
        texel = static_cast<float>(sums_[c][i] / static_cast<double>(hits_[i]));
      }
    }
  }
  return RunStatus::done;
}

/// Of the last run.
void TexelSampler::add_samples(std::size_t count) {
  for (std::size_t c = 0; c < sums_.size(); ++c) {
    const std::vector<float>& result = shader_.result(c);
    for (std::size_t i = 0; i < count; ++i) {
      if (shader_.counts(i)) {
        sums_[c][i] += static_cast<double>(result[i]);
      } else {
        beside_[c][i] = result[i];
      }
    }
  }
  for (std::size_t i = 0; i < count; ++i) hits_[i] += shader_.counts(i) ? 1 : 0;
}

}  // namespace nacre::host
