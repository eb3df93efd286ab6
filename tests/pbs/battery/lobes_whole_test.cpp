// T-CHI and T-CHI-X of single lobes, whole and with other numbers each day.
#include <gtest/gtest.h>

#include "tests/pbs/battery/narrow_trial.h"
#include "tests/pbs/battery/sampling_trial.h"

namespace nacre {
namespace {

constexpr Accuracy accuracies[] = {Accuracy::precise, Accuracy::standard, Accuracy::fast};

class LobesWhole : public testing::TestWithParam<LobeCase> {};

TEST_P(LobesWhole, SamplesFollowTheDensityAndCarryTheLight) {
  const Tier tier = whole_tier();
  for (const Accuracy accuracy : accuracies) try_lobe(GetParam(), accuracy, tier);
}

INSTANTIATE_TEST_SUITE_P(All, LobesWhole, testing::ValuesIn(lobe_cases()),
                         [](const auto& instance) { return instance.param.name; });

class NarrowLobesWhole : public testing::TestWithParam<NarrowCase> {};

TEST_P(NarrowLobesWhole, SamplesFollowTheDensity) {
  const Tier tier = whole_tier();
  for (const Accuracy accuracy : accuracies) try_narrow_lobe(GetParam(), accuracy, tier);
}

INSTANTIATE_TEST_SUITE_P(All, NarrowLobesWhole,
                         testing::ValuesIn(narrow_cases().begin(), narrow_cases().end()),
                         [](const auto& instance) { return instance.param.lobe.name; });

}  // namespace
}  // namespace nacre
