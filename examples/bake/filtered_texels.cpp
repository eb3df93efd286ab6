#include "examples/bake/filtered_texels.h"

#include <algorithm>
#include <cmath>

#include "examples/bake/texel_error.h"
#include "examples/bake/texel_runs.h"

namespace nacre::host {

namespace {

/// Of the look ahead, along both sides of the image: one for so many texels, and so many at most.
constexpr int texels_of_a_look = 64;
constexpr int most_looks = 8;
/// What an error is at least, with squares half as wide, of what it was: blurs fall no faster than
/// with the squares of footprints, and means at an edge may agree by chance.
constexpr float least_left = 0.25f;
/// Where samples of a texel differ by less than so much of an edge beside it, that may have passed
/// by all of them.
constexpr float is_flat = 0.125f;

std::vector<SamplePlace> middles_of_squares(int side) {
  std::vector<SamplePlace> places;
  const float step = 1.0f / static_cast<float>(side);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      places.push_back(
          {(static_cast<float>(x) + 0.5f) * step, (static_cast<float>(y) + 0.5f) * step});
    }
  }
  return places;
}

}  // namespace

FilteredTexels::FilteredTexels(PointShader& shader, float error, Start& start)
    : shader_(shader),
      error_(error),
      width_(static_cast<std::size_t>(shader.width())),
      start_(start) {
  for (int level = 0; level <= finest; ++level) {
    places_.push_back(middles_of_squares(1 << level));
  }
}

RunStatus FilteredTexels::rows(int first, int rows, std::vector<std::vector<float>>& planes,
                               const std::atomic<std::uint32_t>& stop, BakeCounts& counts) {
  RunStatus status = find_start(stop, counts);
  if (status != RunStatus::done) return status;
  // Those around the rows asked for too, if they can call for more samples of these.
  const bool is_last = *first_level_ == finest;
  const int top = is_last ? first : std::max(0, first - 1);
  const int bottom = is_last ? first + rows : std::min(shader_.height(), first + rows + 1);
  shader_.enter(top, bottom - top);
  const std::size_t all = static_cast<std::size_t>(bottom - top) * width_;
  for (Means* means : {&means_, &before_, &spreads_}) {
    means->assign(static_cast<std::size_t>(shader_.components()), std::vector<float>(all));
  }
  std::vector<std::size_t> texels;
  covered_.assign(all, 0);
  for (std::size_t i = 0; i < all; ++i) {
    if (!shader_.covers(static_cast<std::size_t>(top) * width_ + i)) continue;
    covered_[i] = 1;
    texels.push_back(i);
  }
  status = sample(*first_level_ - 1, top, texels, before_, stop, counts);
  if (status == RunStatus::done) {
    status = sample(*first_level_, top, texels, means_, stop, counts, &spreads_);
  }
  if (status != RunStatus::done) return status;
  errors_.assign(all, 0.0f);
  for (const std::size_t i : texels) errors_[i] = difference(means_, before_, i);

  const std::size_t begin = static_cast<std::size_t>(first - top) * width_;
  const std::size_t end = begin + static_cast<std::size_t>(rows) * width_;
  std::erase_if(texels, [&](std::size_t i) {
    if (i < begin || i >= end) return true;
    return is_last ? !(errors_[i] > error_)
                   : !(unseen(i) > error_) && !is_any_above(errors_, width_, i, error_);
  });
  for (const std::size_t i : texels) errors_[i] = std::max(errors_[i], unseen(i));
  for (int level = *first_level_ + 1; level <= finest && !texels.empty(); ++level) {
    for (std::size_t c = 0; c < means_.size(); ++c) {
      for (const std::size_t i : texels) before_[c][i] = means_[c][i];
    }
    status = sample(level, top, texels, means_, stop, counts);
    if (status != RunStatus::done) return status;
    std::erase_if(texels, [&](std::size_t i) {
      errors_[i] = std::max(difference(means_, before_, i), least_left * errors_[i]);
      return !(errors_[i] > error_);
    });
  }
  counts.unfinished += texels.size();
  for (std::size_t c = 0; c < planes.size(); ++c) {
    planes[c].assign(means_[c].begin() + static_cast<std::ptrdiff_t>(begin),
                     means_[c].begin() + static_cast<std::ptrdiff_t>(end));
  }
  return RunStatus::done;
}

RunStatus FilteredTexels::find_start(const std::atomic<std::uint32_t>& stop, BakeCounts& counts) {
  if (first_level_) return RunStatus::done;
  const std::lock_guard lock(start_.mutex);
  const RunStatus status = start_.level ? RunStatus::done : look_ahead(stop, counts);
  first_level_ = start_.level;
  return status;
}

RunStatus FilteredTexels::look_ahead(const std::atomic<std::uint32_t>& stop, BakeCounts& counts) {
  const int looks =
      std::clamp(std::min(shader_.width(), shader_.height()) / texels_of_a_look, 1, most_looks);
  std::size_t seen = 0;
  std::vector<std::size_t> off(finest, 0);  // Texels that each level is not exact enough for.
  for (int look = 0; look < looks; ++look) {
    const int row = (2 * look + 1) * shader_.height() / (2 * looks);
    shader_.enter(row, 1);
    const std::vector<std::size_t> texels = covered_of_row(row, static_cast<std::size_t>(looks));
    if (texels.empty()) continue;
    std::vector<Means> means(finest + 1, Means(static_cast<std::size_t>(shader_.components()),
                                               std::vector<float>(width_)));
    for (int level = 1; level <= finest; ++level) {
      const RunStatus status =
          sample(level, row, texels, means[static_cast<std::size_t>(level)], stop, counts);
      if (status != RunStatus::done) return status;
    }
    seen += texels.size();
    for (std::size_t level = 1; level < off.size(); ++level) {
      for (const std::size_t i : texels) {
        if (difference(means[level], means[finest], i) > error_) ++off[level];
      }
    }
  }
  int level = 1;
  while (level < finest && 8 * off[static_cast<std::size_t>(level)] > seen) ++level;
  start_.level = level;
  return RunStatus::done;
}

/// At most so many, spread over it.
std::vector<std::size_t> FilteredTexels::covered_of_row(int row, std::size_t most) {
  std::vector<std::size_t> covered;
  for (std::size_t i = 0; i < width_; ++i) {
    if (shader_.covers(static_cast<std::size_t>(row) * width_ + i)) covered.push_back(i);
  }
  if (covered.size() <= most) return covered;
  std::vector<std::size_t> some;
  for (std::size_t k = 0; k < most; ++k) {
    some.push_back(covered[(2 * k + 1) * covered.size() / (2 * most)]);
  }
  return some;
}

RunStatus FilteredTexels::sample(int level, int first, const std::vector<std::size_t>& texels,
                                 Means& means, const std::atomic<std::uint32_t>& stop,
                                 BakeCounts& counts, Means* spreads) {
  const std::vector<SamplePlace>& places = places_[static_cast<std::size_t>(level)];
  points_.footprint = 1.0f / static_cast<float>(1 << level);
  return run_texels(shader_, texels, first, places, points_, stop, counts,
                    [&](std::size_t texel, std::size_t begin) {
                      for (std::size_t c = 0; c < means.size(); ++c) {
                        const float* values = shader_.result(c).data() + begin;
                        double sum = 0.0;
                        std::size_t hits = 0;
                        float low = HUGE_VALF, high = -HUGE_VALF;
                        for (std::size_t k = 0; k < places.size(); ++k) {
                          if (!shader_.counts(begin + k)) continue;
                          sum += static_cast<double>(values[k]);
                          low = std::min(low, values[k]);
                          high = std::max(high, values[k]);
                          ++hits;
                        }
                        if (spreads != nullptr) (*spreads)[c][texels[texel]] = high - low;
                        // Where none counts all are the same point, which stands for the texel.
                        means[c][texels[texel]] =
                            hits > 0 ? static_cast<float>(sum / static_cast<double>(hits))
                                     : values[0];
                      }
                    });
}

/// What an edge may be worth that the first squares' samples do not show: an edge as high as a
/// second difference of texels, d, is worth d / 2n of a texel where n samples do not see it, and
/// what is less than four errors is not looked into; see AdaptiveTexels.
float FilteredTexels::unseen(std::size_t texel) const {
  const auto samples = static_cast<float>(places_[static_cast<std::size_t>(*first_level_)].size());
  float widest = 0.0f;
  for (std::size_t c = 0; c < means_.size(); ++c) {
    const float mean = means_[c][texel];
    const float edge = edge_within(neighbours_of(means_[c], covered_, width_, texel), mean);
    if (spreads_[c][texel] > is_flat * edge) continue;
    widest = std::max(widest, texel_error(edge / (8.0f * samples), mean));
  }
  return widest;
}

/// Of the component that differs most, relative to values above 1.
float FilteredTexels::difference(const Means& a, const Means& b, std::size_t texel) const {
  float widest = 0.0f;
  for (std::size_t c = 0; c < a.size(); ++c) {
    const float value = a[c][texel];
    widest = std::max(widest, texel_error(value - b[c][texel], value));
  }
  return widest;
}

}  // namespace nacre::host
