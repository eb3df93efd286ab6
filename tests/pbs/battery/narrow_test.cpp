// T-CHI-X: narrow lobes by chi-square where they are wide.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/pbs/battery/lobe_kernels.h"
#include "tests/pbs/battery/narrow_trial.h"
#include "tests/support/chi_squares.h"

namespace nacre {
namespace {

class NarrowLobes : public testing::TestWithParam<NarrowCase> {};

TEST_P(NarrowLobes, SamplesFollowTheDensity) {
  try_narrow_lobe(GetParam(), Accuracy::standard, daily_tier);
}

std::vector<NarrowCase> daily_cases() {
  std::vector<NarrowCase> rows(narrow_cases().begin(), narrow_cases().end());
  std::erase_if(rows, [](const NarrowCase& row) { return row.daily_share == 0; });
  return rows;
}

INSTANTIATE_TEST_SUITE_P(All, NarrowLobes, testing::ValuesIn(daily_cases()),
                         [](const auto& instance) { return instance.param.lobe.name; });

/// The row of that name.
const NarrowCase& case_of(const std::string& name) {
  return *std::ranges::find_if(narrow_cases(),
                               [&](const NarrowCase& each) { return each.lobe.name == name; });
}

// An eighth more roughness is another lobe, a hundred times narrower than bins of directions.
TEST(NarrowCases, OfAnotherWidthAreFound) {
  for (const char* name : {"metal", "interface", "tilted_hair"}) {
    const NarrowCase& row = case_of(name);
    const float width = row.widths[0], other = width * 1.12f;
    EXPECT_GT(narrow_probability(row, width, width), 1e-3) << name;
    EXPECT_LT(narrow_probability(row, other, width), 1e-6) << name;
  }
}

// The cosine and sine of `fast` are not of length 1: its samples lay 1.6e-5 nearer to the fibre
// than its density. All ways leave at minus the elevation of wo.
TEST(NarrowCases, HairIsSampledWhereItsDensityIs) {
  constexpr std::size_t count = 1 << 19;
  const Direction wo = direction(45.0);
  for (const Accuracy accuracy : {Accuracy::fast, Accuracy::standard}) {
    const LobeKernels kernels(case_of("hair").lobe, accuracy);
    const Sampled samples = kernels.sample(1e-6f, wo, count, 1);
    double sum = 0;
    std::size_t near = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double off = std::asin(double(samples.wi[i].x)) + std::asin(double(wo.x));
      if (!samples.valid[i] || std::abs(off) > 8e-3) continue;
      sum += off, ++near;
    }
    ASSERT_GT(near, count / 2);
    // Of a mean whose deviation is 3e-6 at most: the widest way has 2e-3.
    EXPECT_NEAR(sum / static_cast<double>(near), 0.0, 1e-5) << accuracy_name(accuracy);
  }
}

TEST(NarrowCases, AreNoMoreThanTheLevelIsFor) {
  EXPECT_LE(narrow_chi_squares(), chi_squares_of::narrow_lobes);
}

}  // namespace
}  // namespace nacre
