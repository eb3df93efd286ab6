// T-FUZ, whole: ten million hostile points of every closure and mode, other ones each day.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/pbs/battery/closure_trial.h"
#include "tests/support/tier.h"

namespace nacre {
namespace {

class ClosuresWhole : public testing::TestWithParam<ClosureCase> {};

// NACRE_TEST_POINTS is how many points a row has in each mode.
TEST_P(ClosuresWhole, AreSaneForAnyBits) {
  const Tier tier = whole_tier();
  const std::uint64_t points = number_of("NACRE_TEST_POINTS", 10'000'000);
  fmt::print("NACRE_TEST_POINTS={}\n", points);
  for (const Accuracy mode : {Accuracy::standard, Accuracy::fast, Accuracy::precise}) {
    for (const bool asks_all : {false, true}) {
      try_closure(GetParam(), {.accuracy = mode, .asks_all = asks_all}, points / 2, tier.seed);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, ClosuresWhole,
                         testing::ValuesIn(closure_cases().begin(), closure_cases().end()),
                         [](const auto& instance) { return short_name(instance.param); });

}  // namespace
}  // namespace nacre
