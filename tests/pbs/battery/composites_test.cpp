// T-CHI, T-NORM, T-WGT, T-FUR and T-REC of what is made of several closures.
#include <gtest/gtest.h>

#include "tests/pbs/battery/composite_trial.h"
#include "tests/support/chi_squares.h"

namespace nacre {
namespace {

class Composites : public testing::TestWithParam<Composite> {};

TEST_P(Composites, KeepTheLawsOfLobes) { try_composite(GetParam(), daily_tier); }

INSTANTIATE_TEST_SUITE_P(All, Composites,
                         testing::ValuesIn(composites().begin(), composites().end()),
                         [](const auto& instance) { return instance.param.name; });

TEST(CompositeCases, AreNoMoreThanTheLevelIsFor) {
  EXPECT_LE(composite_chi_squares(), chi_squares_of::composites);
}

}  // namespace
}  // namespace nacre
