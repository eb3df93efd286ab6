#include "examples/bake/adaptive_texels.h"

#include <algorithm>
#include <cmath>

namespace nacre::host {

namespace {

int set_size(std::size_t set) { return 4 << (2 * set); }

}  // namespace

AdaptiveTexels::AdaptiveTexels(PointShader& shader, float error)
    : shader_(shader),
      error_(error),
      width_(static_cast<std::size_t>(shader.width())),
      means_(static_cast<std::size_t>(shader.components())),
      along_(means_.size()),
      across_(means_.size()) {
  for (std::size_t set = 0; set < sets; ++set) places_[set] = sample_places(set_size(set));
}

RunStatus AdaptiveTexels::rows(int first, int rows, std::vector<std::vector<float>>& planes,
                               const std::atomic<std::uint32_t>& stop, BakeCounts& counts) {
  const int above = first > 0 ? 1 : 0;
  const int below = first + rows < shader_.height() ? 1 : 0;
  const std::size_t begin = static_cast<std::size_t>(above) * width_;
  const std::size_t count = static_cast<std::size_t>(rows) * width_;
  shader_.enter(first - above, rows + above + below);
  RunStatus status = first_set(first - above, rows + above + below, stop, counts);
  if (status != RunStatus::done) return status;
  look_around();
  std::vector<std::size_t> texels;
  for (std::size_t i = begin; i < begin + count; ++i) {
    if (covered_[i] != 0 && (is_near_error(i) || wants_more(i, 0))) texels.push_back(i);
  }
  for (std::size_t set = 1; set < sets && !texels.empty(); ++set) {
    status = next_set(set, first - above, texels, stop, counts);
    if (status != RunStatus::done) return status;
    std::erase_if(texels, [&](std::size_t i) { return !wants_more(i, set); });
  }
  counts.unfinished += texels.size();
  for (std::size_t c = 0; c < planes.size(); ++c) {
    const auto from = means_[c].begin() + static_cast<std::ptrdiff_t>(begin);
    planes[c].assign(from, from + static_cast<std::ptrdiff_t>(count));
  }
  return RunStatus::done;
}

RunStatus AdaptiveTexels::first_set(int first, int rows, const std::atomic<std::uint32_t>& stop,
                                    BakeCounts& counts) {
  const std::size_t count = static_cast<std::size_t>(rows) * width_;
  errors_.assign(count, 0.0f);
  for (auto* planes : {&means_, &along_, &across_}) {
    for (std::vector<float>& plane : *planes) plane.assign(count, 0.0f);
  }
  hits_.assign(count, 0);
  covered_.resize(count);
  std::vector<std::size_t> texels;
  for (std::size_t i = 0; i < count; ++i) {
    covered_[i] = shader_.covers(static_cast<std::size_t>(first) * width_ + i) ? 1 : 0;
    if (covered_[i] != 0) texels.push_back(i);
  }
  return next_set(0, first, texels, stop, counts);
}

RunStatus AdaptiveTexels::next_set(std::size_t set, int first,
                                   const std::vector<std::size_t>& texels,
                                   const std::atomic<std::uint32_t>& stop, BakeCounts& counts) {
  const std::vector<SamplePlace>& places = places_[set];
  const std::size_t samples = places.size();
  points_.footprint = 1.0f / std::sqrt(static_cast<float>(samples));
  const std::size_t step = std::max<std::size_t>(1, shader_.points_of_a_run() / samples);
  for (std::size_t begin = 0; begin < texels.size(); begin += step) {
    const std::size_t count = std::min(step, texels.size() - begin);
    points_.x.clear();
    points_.y.clear();
    points_.texel.clear();
    for (std::size_t i = begin; i < begin + count; ++i) {
      const auto column = static_cast<float>(texels[i] % width_);
      const auto row = static_cast<float>(static_cast<std::size_t>(first) + texels[i] / width_);
      for (const SamplePlace& place : places) {
        points_.x.push_back(column + place.x);
        points_.y.push_back(row + place.y);
        points_.texel.push_back(static_cast<std::size_t>(first) * width_ + texels[i]);
      }
    }
    const RunStatus status = shader_.run(points_, stop);
    if (status != RunStatus::done) return status;
    counts.samples += points_.x.size();
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t texel = texels[begin + i];
      float error = set == 0 ? 0.0f : errors_[texel] / 3.0f;
      const std::size_t before = hits_[texel];  // What earlier sets count for.
      std::size_t hits = 0;
      for (std::size_t k = 0; k < samples; ++k) hits += shader_.counts(i * samples + k) ? 1 : 0;
      hits_[texel] += static_cast<std::uint32_t>(hits);
      for (std::size_t c = 0; c < means_.size(); ++c) {
        const float* values = shader_.result(c).data() + i * samples;
        double sum = 0.0;
        for (std::size_t k = 0; k < samples; ++k) {
          if (shader_.counts(i * samples + k)) sum += static_cast<double>(values[k]);
        }
        const float old = means_[c][texel];
        if (set > 0) sum += static_cast<double>(old) * static_cast<double>(before);
        // Where none counts all are the same point, which stands for the texel until one does.
        means_[c][texel] = before + hits == 0
                               ? values[0]
                               : static_cast<float>(sum / static_cast<double>(before + hits));
        if (set == 0) {
          along_[c][texel] = 0.5f * ((values[2] + values[3]) - (values[0] + values[1]));
          across_[c][texel] = 0.5f * ((values[1] + values[3]) - (values[0] + values[2]));
        }
        // The four places of the first set are those of a plane if 0 and 3 are as 1 and 2.
        const float difference = set == 0
                                     ? 0.5f * ((values[0] + values[3]) - (values[1] + values[2]))
                                     : means_[c][texel] - old;
        error = std::max(error, relative(0.5f * difference, c, texel));
      }
      if (set == 0 && hits < samples) error = std::max(error, spread(i * samples, samples, texel));
      errors_[texel] = error;
    }
  }
  return RunStatus::done;
}

/// Where few of the first samples are on the surface: as if another one was as far from the mean.
float AdaptiveTexels::spread(std::size_t first, std::size_t samples, std::size_t texel) const {
  float widest = 0.0f;
  for (std::size_t c = 0; c < means_.size(); ++c) {
    for (std::size_t k = first; k < first + samples; ++k) {
      if (!shader_.counts(k)) continue;
      const float difference = shader_.result(c)[k] - means_[c][texel];
      widest = std::max(widest, relative(difference, c, texel));
    }
  }
  return widest;
}

float AdaptiveTexels::relative(float difference, std::size_t component, std::size_t texel) const {
  return std::abs(difference) / std::max(1.0f, std::abs(means_[component][texel]));
}

/// At the edges of the image and of the surface a texel stands for the one that is not there.
void AdaptiveTexels::look_around() {
  edges_.assign(errors_.size(), 0.0f);
  for (std::size_t c = 0; c < means_.size(); ++c) {
    const std::vector<float>& mean = means_[c];
    for (std::size_t i = 0; i < mean.size(); ++i) {
      if (covered_[i] == 0) continue;
      const std::size_t x = i % width_;
      const float here = mean[i];
      const auto at = [&](std::size_t other) { return covered_[other] != 0 ? mean[other] : here; };
      const float left = x > 0 ? at(i - 1) : here;
      const float right = x + 1 < width_ ? at(i + 1) : here;
      const float up = i >= width_ ? at(i - width_) : here;
      const float down = i + width_ < mean.size() ? at(i + width_) : here;
      const float along = relative(left + right - 2.0f * here, c, i);
      const float across = relative(up + down - 2.0f * here, c, i);
      edges_[i] = std::max({edges_[i], along, across});
      compare_slopes(c, i, 0.5f * (right - left), 0.5f * (down - up));
    }
  }
}

/// Those of the first set's samples with those of the neighbours' means. Of the samples' pairs the
/// middles are half a texel from each other along one axis, a quarter along the other.
void AdaptiveTexels::compare_slopes(std::size_t component, std::size_t texel, float along,
                                    float across) {
  const float of_columns = along_[component][texel] - (0.5f * along + 0.25f * across);
  const float of_rows = across_[component][texel] - (0.25f * along + 0.5f * across);
  errors_[texel] = std::max({errors_[texel], relative(0.25f * of_columns, component, texel),
                             relative(0.25f * of_rows, component, texel)});
}

bool AdaptiveTexels::wants_more(std::size_t texel, std::size_t set) const {
  const float unseen = edges_[texel] / static_cast<float>(2 * set_size(set));
  return errors_[texel] > error_ || unseen > 4.0f * error_;
}

bool AdaptiveTexels::is_near_error(std::size_t texel) const {
  const std::size_t x = texel % width_;
  const std::size_t y = texel / width_;
  const std::size_t rows = errors_.size() / width_;
  for (std::size_t j = y > 0 ? y - 1 : 0; j < std::min(y + 2, rows); ++j) {
    for (std::size_t i = x > 0 ? x - 1 : 0; i < std::min(x + 2, width_); ++i) {
      if (errors_[j * width_ + i] > error_) return true;
    }
  }
  return false;
}

}  // namespace nacre::host
