#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "tests/pbs/battery/sampling_trial.h"
#include "tests/support/chi_squares.h"

namespace nacre {
namespace {

class Lobes : public testing::TestWithParam<std::tuple<LobeCase, Accuracy>> {};

TEST_P(Lobes, SamplesFollowTheDensityAndCarryTheLight) {
  const auto& [row, accuracy] = GetParam();
  try_lobe(row, accuracy, daily_tier);
}

// A host that runs a path backwards relies on it. For `fast` LLVM may order sums and products as
// it likes, in two kernels' code differently; the interpreter keeps their order.
TEST_P(Lobes, ReverseDensityIsTheForwardOneOfTheSwappedPair) {
  const auto& [row, accuracy] = GetParam();
  const bool is_fast = accuracy == Accuracy::fast;
  const LobeKernels kernels(row, accuracy, is_fast ? Backend::interpreter : Backend::jit, true);
  double worst = 1.0;
  each_lobe_view(row, daily_tier, [&](float roughness, Direction wo, std::uint64_t seed) {
    const Sampled samples = kernels.sample(roughness, wo, 2000, seed);
    std::vector<Direction> wi;
    for (std::size_t i = 0; i < samples.wi.size(); ++i) {
      if (samples.valid[i]) wi.push_back(samples.wi[i]);
    }
    if (wi.empty()) return;
    const Evaluated there = kernels.evaluate(roughness, wo, wi);
    const Evaluated back = kernels.evaluate(roughness, wi, {wo});
    for (std::size_t i = 0; i < wi.size(); ++i) {
      ASSERT_EQ(there.pdf_reverse[i], back.pdf[i]);
      ASSERT_EQ(back.pdf_reverse[i], there.pdf[i]);
      const double f = there.f[i] * std::abs(double(wo.z));
      const double g = back.f[i] * std::abs(double(wi[i].z));
      if (std::max(f, g) < 1e-6) continue;
      worst = std::max({worst, f / g, g / f});
    }
  });
  // Reciprocal, or as far from it as was measured when the row was written.
  const double error = row.reciprocity == 1.0 ? 2e-4 : 2e-2 * row.reciprocity;
  if (row.reciprocity > 0.0) {
    EXPECT_NEAR(worst, row.reciprocity, error);
  }
}

TEST(LobeCases, AreNoMoreThanTheLevelIsFor) {
  EXPECT_LE(lobe_chi_squares(), chi_squares_of::lobes);
}

std::string case_name(const testing::TestParamInfo<std::tuple<LobeCase, Accuracy>>& info) {
  return std::get<0>(info.param).name + "_" + std::string(accuracy_name(std::get<1>(info.param)));
}

INSTANTIATE_TEST_SUITE_P(All, Lobes,
                         testing::Combine(testing::ValuesIn(lobe_cases()),
                                          testing::Values(Accuracy::standard, Accuracy::fast)),
                         case_name);

}  // namespace
}  // namespace nacre
