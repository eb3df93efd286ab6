// T-FUZ, whole: ten million hostile points of every closure, other ones each day.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/pbs/battery/closure_trial.h"
#include "tests/support/tier.h"

namespace nacre {
namespace {

class ClosuresWhole : public testing::TestWithParam<ClosureCase> {};

// NACRE_TEST_POINTS is how many points a row has.
TEST_P(ClosuresWhole, AreSaneForAnyBits) {
  const Tier tier = whole_tier();
  const std::uint64_t points = number_of("NACRE_TEST_POINTS", 10'000'000);
  fmt::print("NACRE_TEST_POINTS={}\n", points);
  const ClosureWay ways[] = {{.accuracy = Accuracy::standard},
                             {.accuracy = Accuracy::standard, .asks_all = true},
                             {.accuracy = Accuracy::fast},
                             {.accuracy = Accuracy::fast, .asks_all = true},
                             {.accuracy = Accuracy::precise}};
  for (const ClosureWay& way : ways)
    try_closure(GetParam(), way, points / std::size(ways), tier.seed);
}

INSTANTIATE_TEST_SUITE_P(All, ClosuresWhole,
                         testing::ValuesIn(closure_cases().begin(), closure_cases().end()),
                         [](const auto& instance) { return short_name(instance.param); });

}  // namespace
}  // namespace nacre
