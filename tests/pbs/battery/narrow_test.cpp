// T-CHI-X: narrow lobes by chi-square where they are wide.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

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

// An eighth more roughness is another lobe, a hundred times narrower than bins of directions.
TEST(NarrowCases, OfAnotherWidthAreFound) {
  for (const char* name : {"metal", "interface", "tilted_hair"}) {
    const auto row = std::ranges::find_if(
        narrow_cases(), [&](const NarrowCase& each) { return each.lobe.name == name; });
    ASSERT_NE(row, narrow_cases().end());
    const float width = row->widths[0], other = width * 1.12f;
    EXPECT_GT(narrow_probability(*row, width, width), 1e-3) << name;
    EXPECT_LT(narrow_probability(*row, other, width), 1e-6) << name;
  }
}

TEST(NarrowCases, AreNoMoreThanTheLevelIsFor) {
  EXPECT_LE(narrow_chi_squares(), chi_squares_of::narrow_lobes);
}

}  // namespace
}  // namespace nacre
