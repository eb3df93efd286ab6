#include "tests/pbs/battery/narrow_trial.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nacre/lobe_test/sphere_partition.hpp>
#include <numeric>

#include "tests/pbs/battery/lobe_kernels.h"
#include "tests/support/chi_squares.h"

namespace nacre {

namespace {

/// Samples of one view, and the density that they should have.
class NarrowTrial {
 public:
  /// `width` of the density; samples are those of another one where somebody wants to know what
  /// that does.
  NarrowTrial(const LobeKernels& kernels, const NarrowWarp& warp, float width, Direction wo,
              const Sampled& samples)
      : kernels_(kernels),
        warp_(warp),
        width_(width),
        wo_(wo),
        samples_(samples),
        places_(places_of(samples)) {
    for (std::size_t sphere = 0; sphere < warp.spheres(); ++sphere) add(sphere);
  }

  double valid() const {
    return static_cast<double>(places_.size()) / static_cast<double>(samples_.wi.size());
  }
  double pdf_integral() const { return std::reduce(expected_.begin(), expected_.end()); }
  double chi_square() const { return chi_square_probability(counts_, expected_); }

  void check_weights() const {
    const Evaluated again = kernels_.evaluate(width_, wo_, samples_.wi);
    for (std::size_t i = 0; i < samples_.wi.size(); ++i) {
      if (!samples_.valid[i]) continue;
      const Direction w = samples_.wi[i];
      ASSERT_NEAR(w.x * w.x + w.y * w.y + w.z * w.z, 1.0f, 1e-5f);
      ASSERT_GT(again.pdf[i], 0.0f) << i;
      ASSERT_NEAR(samples_.pdf[i], again.pdf[i], 1e-4 * again.pdf[i]) << i;
      const double weight = again.f[i] / again.pdf[i];
      ASSERT_NEAR(samples_.weight[i], weight, 1e-4 * weight + 1e-12) << i;
    }
  }

 private:
  std::vector<NarrowWarp::Place> places_of(const Sampled& samples) const {
    std::vector<NarrowWarp::Place> places;
    for (std::size_t i = 0; i < samples.wi.size(); ++i) {
      if (samples.valid[i]) places.push_back(warp_.place(samples.wi[i]));
    }
    return places;
  }

  /// The cells of one sphere: samples in them and the integral of the density.
  void add(std::size_t sphere) {
    // Others than those that are counted: cells that are cut about a sample have one too many.
    static constexpr std::uint64_t pilot_seed = 1;
    std::vector<Direction> pilot;
    for (const NarrowWarp::Place& place :
         places_of(kernels_.sample(width_, wo_, samples_.wi.size(), pilot_seed))) {
      if (place.sphere == sphere && pilot.size() < 4096) pilot.push_back(place.on);
    }
    // Where few samples are, each is to be looked at: what is dark to the first nodes is not empty.
    const std::vector<Direction> few = pilot;
    while (!few.empty() && pilot.size() < 4096) {
      pilot.insert(pilot.end(), few.begin(), few.end());
    }
    const SpherePartition cells([&](const auto& on) { return densities(sphere, on); }, pilot,
                                static_cast<double>(samples_.wi.size()));
    const std::size_t first = counts_.size();
    counts_.resize(first + cells.cells(), 0.0);
    for (std::size_t c = 0; c < cells.cells(); ++c) expected_.push_back(cells.pdf(c));
    for (const NarrowWarp::Place& place : places_) {
      if (place.sphere == sphere) counts_[first + cells.find(place.on)] += 1.0;
    }
  }

  SpherePartition::Densities densities(std::size_t sphere, const std::vector<Direction>& on) const {
    std::vector<Direction> wi;
    std::vector<double> scale;
    for (const Direction& each : on) {
      const NarrowWarp::Back back = warp_.back({sphere, each});
      wi.push_back(back.scale > 0.0 ? back.wi : wo_);
      scale.push_back(back.scale);
    }
    const Evaluated values = kernels_.evaluate(width_, wo_, wi);
    SpherePartition::Densities made;
    for (std::size_t i = 0; i < on.size(); ++i) {
      made.pdf.push_back(static_cast<float>(values.pdf[i] * scale[i]));
    }
    made.f = made.pdf;
    return made;
  }

  const LobeKernels& kernels_;
  const NarrowWarp& warp_;
  float width_;
  Direction wo_;
  const Sampled& samples_;
  std::vector<NarrowWarp::Place> places_;  ///< Of valid samples.
  std::vector<double> counts_, expected_;  ///< By cell: samples, and the integral of the density.
};

/// Whether directions of floats lie close enough together in the lobe: those of facets are half as
/// far apart as the directions, over the cosine.
bool has_digits(const NarrowCase& row, float width, Direction wo) {
  const bool is_fibre = row.lobe.category == "chiang_hair_bsdf";
  return is_fibre || 0x1p-24f < 4e-3f * 2.0f * std::abs(wo.z) * width;
}

/// Below it facets are mirrors: `Facets::threshold`.
float least_width(Accuracy accuracy) { return accuracy == Accuracy::fast ? 1e-3f : 0.0f; }

}  // namespace

void try_narrow_lobe(const NarrowCase& row, Accuracy accuracy, const Tier& tier) {
  const LobeKernels kernels(row.lobe, accuracy);
  const std::size_t count = tier.whole ? 400'000 : 40'000;
  std::uint64_t number = tier.seed;
  for (std::size_t w = 0; w < row.widths.size(); ++w) {
    const float width = row.widths[w];
    if (row.lobe.category != "chiang_hair_bsdf" && width < least_width(accuracy)) continue;
    for (std::size_t a = 0; a < row.angles.size(); ++a) {
      ++number;
      if (!tier.whole && (w + a) % row.daily_share != 0) continue;
      SCOPED_TRACE(
          fmt::format("{} width {} angle {} seed {}", row.lobe.name, width, row.angles[a], number));
      const Direction wo = direction(row.angles[a]);
      if (!has_digits(row, width, wo)) continue;
      const std::unique_ptr<NarrowWarp> warp = row.warp(width, wo);
      const Sampled samples = kernels.sample(width, wo, count, number);
      const NarrowTrial trial(kernels, *warp, width, wo, samples);
      trial.check_weights();
      if (testing::Test::HasFatalFailure()) return;
      EXPECT_NEAR(trial.pdf_integral(), trial.valid(),
                  1e-3 + 5.5 * std::sqrt(trial.valid() * (1.0 - trial.valid()) /
                                         static_cast<double>(count)));
      ASSERT_GT(trial.valid(), 0.0);
      EXPECT_GT(trial.chi_square(), chi_square_level());
    }
  }
}

double narrow_probability(const NarrowCase& row, float sampled, float claimed) {
  const LobeKernels kernels(row.lobe, Accuracy::standard);
  const Direction wo = direction(45.0);
  const std::unique_ptr<NarrowWarp> warp = row.warp(claimed, wo);
  const Sampled samples = kernels.sample(sampled, wo, 100'000, 2);
  return NarrowTrial(kernels, *warp, claimed, wo, samples).chi_square();
}

int narrow_chi_squares() {
  std::size_t count = 0;
  for (const NarrowCase& row : narrow_cases()) count += row.widths.size() * row.angles.size();
  return static_cast<int>(3 * count);
}

}  // namespace nacre
