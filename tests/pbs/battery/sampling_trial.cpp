#include "tests/pbs/battery/sampling_trial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nacre/lobe_test/sphere_partition.hpp>
#include <utility>

#include "tests/support/chi_squares.h"

namespace nacre {

namespace {

constexpr float roughnesses[] = {0.05f, 0.1f, 0.3f, 0.6f, 1.0f};
constexpr double angles[] = {0.0, 30.0, 60.0, 80.0, 85.0, 130.0, 160.0};

/// One sample in so many is drawn for the partition first: what none of them shows is few samples.
constexpr std::size_t pilots = 16;

std::vector<float> roughnesses_of(const LobeCase& row) {
  std::vector<float> list;
  for (const float r : roughnesses) {
    if (row.rough ? r >= row.least_roughness : r == 1.0f) list.push_back(r);
  }
  return list;
}

/// What one configuration's samples and quadrature say.
struct Trial {
  Trial(const LobeKernels& kernels, float roughness, Direction wo, std::uint64_t seed,
        std::size_t count)
      : samples(kernels.sample(roughness, wo, count, seed)),
        cells(
            [&](const std::vector<Direction>& wi) {
              Evaluated values = kernels.evaluate(roughness, wo, wi);
              return SpherePartition::Densities{std::move(values.pdf), std::move(values.f)};
            },
            kernels.sample(roughness, wo, count / pilots, ~seed).wi, static_cast<double>(count)) {}

  double valid_fraction() const {
    return static_cast<double>(std::ranges::count(samples.valid, true)) /
           static_cast<double>(samples.valid.size());
  }
  double chi_square() const {
    std::vector<double> counts(cells.cells(), 0.0), expected(cells.cells());
    for (std::size_t i = 0; i < samples.wi.size(); ++i) {
      if (samples.valid[i]) counts[cells.find(samples.wi[i])] += 1.0;
    }
    for (std::size_t c = 0; c < expected.size(); ++c) expected[c] = cells.pdf(c);
    return chi_square_probability(counts, expected);
  }
  /// Mean of the weights and the deviation of that mean.
  std::pair<double, double> light() const {
    double sum = 0.0, squares = 0.0;
    for (const float w : samples.weight) sum += w, squares += double(w) * w;
    const double n = static_cast<double>(samples.weight.size());
    const double mean = sum / n;
    return {mean, std::sqrt(std::max(squares / n - mean * mean, 0.0) / n)};
  }

  Sampled samples;
  SpherePartition cells;
};

void check_weights(const LobeKernels& kernels, float roughness, Direction wo,
                   const Sampled& samples) {
  const Evaluated again = kernels.evaluate(roughness, wo, samples.wi);
  for (std::size_t i = 0; i < samples.wi.size(); ++i) {
    if (!samples.valid[i]) {
      ASSERT_EQ(samples.weight[i], 0.0f);
      ASSERT_EQ(samples.pdf[i], 0.0f);
      continue;
    }
    const Direction w = samples.wi[i];
    ASSERT_NEAR(w.x * w.x + w.y * w.y + w.z * w.z, 1.0f, 1e-5f);
    ASSERT_GT(again.pdf[i], 0.0f);
    ASSERT_NEAR(samples.pdf[i], again.pdf[i], 1e-4f * again.pdf[i]);
    const float weight = again.f[i] / again.pdf[i];
    ASSERT_NEAR(samples.weight[i], weight, 1e-4f * weight + 1e-12f) << i;
  }
}

void check_energy(const LobeCase& row, double light, double albedo) {
  switch (row.energy) {
    case Energy::conserving: EXPECT_LE(light, 1.0 + 1e-3); break;
    case Energy::preserving: EXPECT_NEAR(light, 1.0, row.preserving_error); break;
    case Energy::exceeding: break;  // The brightest of all is pinned.
  }
  EXPECT_NEAR(albedo, std::min(light, 1.0), row.albedo_error);
}

/// Of a mean of 0s and 1s over so many samples, by chance once in 2.6e7.
double deviation_of_fraction(double fraction, std::size_t samples) {
  return 5.5 * std::sqrt(fraction * (1.0 - fraction) / static_cast<double>(samples));
}

}  // namespace

void each_lobe_view(const LobeCase& row, const Tier& tier, const LobeViewCheck& check) {
  std::uint64_t number = tier.seed;
  for (const float roughness : roughnesses_of(row)) {
    for (const double angle : angles) {
      SCOPED_TRACE(testing::Message() << "roughness " << roughness << " angle " << angle);
      check(roughness, direction(angle), ++number);
    }
  }
}

void try_lobe(const LobeCase& row, Accuracy accuracy, const Tier& tier) {
  const LobeKernels kernels(row, accuracy);
  const std::size_t count = tier.whole ? 1'000'000 : 100'000;
  double brightest = 0.0;
  each_lobe_view(row, tier, [&](float roughness, Direction wo, std::uint64_t seed) {
    const Trial trial(kernels, roughness, wo, seed, count);
    const double valid = trial.valid_fraction();
    // A lobe too dark to be chosen has no samples and no density.
    EXPECT_NEAR(trial.cells.pdf_integral(), valid,
                valid == 0.0 ? 0.0 : 5e-4 + deviation_of_fraction(valid, count));
    if (valid > 0.0) {
      EXPECT_GT(trial.chi_square(), chi_square_level());
    }
    brightest = std::max(brightest, trial.cells.f_integral());
    const auto [mean, deviation] = trial.light();
    EXPECT_NEAR(mean, trial.cells.f_integral(), 5.5 * deviation + 5e-4);
    check_energy(row, trial.cells.f_integral(), kernels.albedo(roughness, wo));
    check_weights(kernels, roughness, wo, trial.samples);
  });
  if (row.energy == Energy::exceeding) {
    EXPECT_NEAR(brightest, row.most_light, 2e-3);
  }
}

int lobe_chi_squares() {
  std::size_t count = 0;
  for (const LobeCase& row : lobe_cases()) {
    count += roughnesses_of(row).size() * std::size(angles);
  }
  return static_cast<int>(3 * count);
}

}  // namespace nacre
