#include "examples/bake/adaptive_texels.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "examples/bake/texel_error.h"
#include "examples/bake/texel_runs.h"

namespace nacre::host {

namespace {

constexpr std::size_t first_samples = 4;
/// What the error at edges falls by with four times the samples: these sets' is n^-3/4.
constexpr float quarter_of_all = 0.35f;
/// What a mean still has of a blur, of what the newer half's is less than the older's: 1.5 times if
/// it falls with the squares of footprints, which are sqrt(1/2) as wide, 2.9 if with themselves.
constexpr float left_of_gap = 2.0f;
/// What an error is at least, with twice the samples, of what it was.
constexpr float least_left = 0.35f;
/// The same where the surface's edge is in the texel: quarters of few samples that count say
/// little, and errors at edges fall by 2^-3/4.
constexpr float least_left_of_cut = 0.6f;

/// By how much the two of the first four samples on the right exceed those on the left, and the two
/// below those above.
/// @{
float right_of_left(const float* values) {
  return 0.5f * ((values[1] + values[3]) - (values[0] + values[2]));
}
float below_of_above(const float* values) {
  return 0.5f * ((values[1] + values[2]) - (values[0] + values[3]));
}
/// @}

double area(const SamplePlace& a, const SamplePlace& b, const SamplePlace& c) {
  return double(b.x - a.x) * double(c.y - a.y) - double(b.y - a.y) * double(c.x - a.x);
}

/// Factors of the first four samples, whose sum is 0 for values of a plane; their sizes add up
/// to 1.
std::array<float, first_samples> off_plane(const std::vector<SamplePlace>& p) {
  const std::array areas{area(p[1], p[2], p[3]), -area(p[0], p[2], p[3]), area(p[0], p[1], p[3]),
                         -area(p[0], p[1], p[2])};
  double all = 0.0;
  for (const double one : areas) all += std::abs(one);
  std::array<float, first_samples> factors{};
  for (std::size_t k = 0; k < factors.size(); ++k) factors[k] = float(areas[k] / all);
  return factors;
}

}  // namespace

AdaptiveTexels::AdaptiveTexels(PointShader& shader, float error)
    : shader_(shader),
      error_(error),
      width_(static_cast<std::size_t>(shader.width())),
      places_(sample_sequence(most_samples)),
      means_(static_cast<std::size_t>(shader.components())),
      first_half_(means_.size()),
      second_half_(means_.size()),
      along_(means_.size()),
      across_(means_.size()) {
  std::array<float, first_samples> x{}, y{};
  for (std::size_t k = 0; k < first_samples; ++k) {
    x[k] = places_[k].x;
    y[k] = places_[k].y;
  }
  along_step_ = {right_of_left(x.data()), right_of_left(y.data())};
  across_step_ = {below_of_above(x.data()), below_of_above(y.data())};
  off_plane_ = off_plane(places_);
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
    if (covered_[i] == 0) continue;
    if (is_any_above(errors_, width_, i, error_) || wants_more(i, first_samples))
      texels.push_back(i);
  }
  for (std::size_t total = 2 * first_samples; total <= std::size_t{most_samples} && !texels.empty();
       total *= 2) {
    status = add_samples(total, first - above, texels, stop, counts);
    if (status != RunStatus::done) return status;
    std::erase_if(texels, [&](std::size_t i) { return !wants_more(i, total); });
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
  for (auto* planes : {&means_, &first_half_, &second_half_, &along_, &across_}) {
    for (std::vector<float>& plane : *planes) plane.assign(count, 0.0f);
  }
  hits_.assign(count, 0);
  covered_.resize(count);
  std::vector<std::size_t> texels;
  for (std::size_t i = 0; i < count; ++i) {
    covered_[i] = shader_.covers(static_cast<std::size_t>(first) * width_ + i) ? 1 : 0;
    if (covered_[i] != 0) texels.push_back(i);
  }
  return add_samples(first_samples, first, texels, stop, counts);
}

RunStatus AdaptiveTexels::add_samples(std::size_t total, int first,
                                      const std::vector<std::size_t>& texels,
                                      const std::atomic<std::uint32_t>& stop, BakeCounts& counts) {
  const std::size_t from = total == first_samples ? 0 : total / 2;
  const std::size_t samples = total - from;
  points_.footprint = 1.0f / std::sqrt(static_cast<float>(total));
  return run_texels(shader_, texels, first, std::span(places_).subspan(from, samples), points_,
                    stop, counts, [&](std::size_t texel, std::size_t begin) {
                      add_result(texels[texel], begin, samples, from == 0);
                    });
}

/// Of the last run the `count` samples from `begin` on.
void AdaptiveTexels::add_result(std::size_t texel, std::size_t begin, std::size_t count,
                                bool is_first) {
  const std::size_t before = hits_[texel];  // What earlier samples count for.
  std::array<std::size_t, 2> hits{};        // Of the halves.
  for (std::size_t k = 0; k < count; ++k) {
    if (shader_.counts(begin + k)) ++hits[2 * k / count];
  }
  const std::size_t added = hits[0] + hits[1];
  hits_[texel] += static_cast<std::uint32_t>(added);
  const bool is_cut = hits_[texel] < (is_first ? count : 2 * count);
  float error = is_first ? 0.0f : (is_cut ? least_left_of_cut : least_left) * errors_[texel];
  for (std::size_t c = 0; c < means_.size(); ++c) {
    const float* values = shader_.result(c).data() + begin;
    std::array<double, 2> sums{};
    for (std::size_t k = 0; k < count; ++k) {
      if (shader_.counts(begin + k)) sums[2 * k / count] += static_cast<double>(values[k]);
    }
    const double sum = static_cast<double>(means_[c][texel]) * static_cast<double>(before);
    // Where none counts all are the same point, which stands for the texel until one does.
    const float mean =
        before + added == 0
            ? values[0]
            : static_cast<float>((sum + sums[0] + sums[1]) / static_cast<double>(before + added));
    means_[c][texel] = mean;
    std::array<float, 2> halves{mean, mean};
    for (std::size_t k = 0; k < 2; ++k) {
      if (hits[k] > 0) halves[k] = static_cast<float>(sums[k] / static_cast<double>(hits[k]));
    }
    error = std::max(
        error, is_first ? error_of_four(c, texel, begin) : error_of_quarters(c, texel, halves));
    first_half_[c][texel] =
        is_first ? halves[0] : 0.5f * (first_half_[c][texel] + second_half_[c][texel]);
    second_half_[c][texel] = is_first ? halves[1] : 0.5f * (halves[0] + halves[1]);
  }
  if (is_first && added < count) error = std::max(error, spread(begin, count, texel));
  errors_[texel] = error;
}

float AdaptiveTexels::error_of_four(std::size_t component, std::size_t texel, std::size_t begin) {
  const float* values = shader_.result(component).data() + begin;
  along_[component][texel] = right_of_left(values);
  across_[component][texel] = below_of_above(values);
  float difference = 0.0f;
  for (std::size_t k = 0; k < first_samples; ++k) difference += off_plane_[k] * values[k];
  return relative(difference, component, texel);
}

float AdaptiveTexels::error_of_quarters(std::size_t component, std::size_t texel,
                                        const std::array<float, 2>& added) {
  const std::array<float, 4> quarters{first_half_[component][texel], second_half_[component][texel],
                                      added[0], added[1]};
  const float mean = 0.25f * (quarters[0] + quarters[1] + quarters[2] + quarters[3]);
  float squares = 0.0f;
  for (const float quarter : quarters) squares += (quarter - mean) * (quarter - mean);
  const auto [low_old, high_old] = std::minmax(quarters[0], quarters[1]);
  const auto [low_new, high_new] = std::minmax(quarters[2], quarters[3]);
  const float gap = std::max({0.0f, low_new - high_old, low_old - high_new});
  const float error = std::max(quarter_of_all * std::sqrt(squares / 3.0f), left_of_gap * gap);
  return relative(error, component, texel);
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
  return texel_error(difference, means_[component][texel]);
}

void AdaptiveTexels::look_around() {
  edges_.assign(errors_.size(), 0.0f);
  for (std::size_t c = 0; c < means_.size(); ++c) {
    const std::vector<float>& mean = means_[c];
    for (std::size_t i = 0; i < mean.size(); ++i) {
      if (covered_[i] == 0) continue;
      const Neighbours beside = neighbours_of(mean, covered_, width_, i);
      edges_[i] = std::max(edges_[i], relative(edge_within(beside, mean[i]), c, i));
      compare_slopes(c, i, 0.5f * (beside.right - beside.left), 0.5f * (beside.down - beside.up));
    }
  }
}

/// Those of the first four samples with those of the neighbours' means.
void AdaptiveTexels::compare_slopes(std::size_t component, std::size_t texel, float along,
                                    float across) {
  const auto of_plane = [&](const SamplePlace& step) { return along * step.x + across * step.y; };
  const float of_columns = along_[component][texel] - of_plane(along_step_);
  const float of_rows = across_[component][texel] - of_plane(across_step_);
  errors_[texel] = std::max({errors_[texel], relative(0.25f * of_columns, component, texel),
                             relative(0.25f * of_rows, component, texel)});
}

bool AdaptiveTexels::wants_more(std::size_t texel, std::size_t total) const {
  const float unseen = edges_[texel] / static_cast<float>(2 * total);
  return errors_[texel] > error_ || unseen > 4.0f * error_;
}

}  // namespace nacre::host
