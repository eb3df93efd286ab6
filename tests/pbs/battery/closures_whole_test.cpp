// T-FUZ, whole: ten million hostile points of every closure, other ones each day.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <string>

#include "tests/pbs/battery/closure_trial.h"

namespace nacre {
namespace {

/// Of the environment, to repeat or to shorten a run.
std::uint64_t number_of(const char* variable, std::uint64_t otherwise) {
  const char* const text = std::getenv(variable);
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

std::uint64_t seed_of_today() {
  using Days = std::chrono::duration<std::uint64_t, std::ratio<86400>>;
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<Days>(now).count() * 1'000'000;
}

class ClosuresWhole : public testing::TestWithParam<ClosureCase> {};

// NACRE_TEST_SEED is where seeds count from, NACRE_TEST_POINTS how many points a row has.
TEST_P(ClosuresWhole, AreSaneForAnyBits) {
  const std::uint64_t seed = number_of("NACRE_TEST_SEED", seed_of_today());
  const std::uint64_t points = number_of("NACRE_TEST_POINTS", 10'000'000);
  fmt::print("NACRE_TEST_SEED={} NACRE_TEST_POINTS={}\n", seed, points);
  const ClosureWay ways[] = {{.accuracy = Accuracy::standard},
                             {.accuracy = Accuracy::standard, .asks_all = true},
                             {.accuracy = Accuracy::fast},
                             {.accuracy = Accuracy::fast, .asks_all = true},
                             {.accuracy = Accuracy::precise}};
  for (const ClosureWay& way : ways) try_closure(GetParam(), way, points / std::size(ways), seed);
}

INSTANTIATE_TEST_SUITE_P(All, ClosuresWhole,
                         testing::ValuesIn(closure_cases().begin(), closure_cases().end()),
                         [](const auto& instance) { return short_name(instance.param); });

}  // namespace
}  // namespace nacre
