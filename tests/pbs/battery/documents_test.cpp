// T-SPEC: specialised kernels of random documents against general ones.
#include <gtest/gtest.h>
#include <nacre/nacre.h>

#include "tests/pbs/battery/document_trial.h"

namespace nacre {
namespace {

class Documents : public testing::TestWithParam<int> {};

TEST_P(Documents, SpecialisedAreAsGeneralOnes) {
  for (int i = 0; i < 16; ++i) {
    const auto number = static_cast<std::uint64_t>(16 * GetParam() + i);
    try_document(daily_tier.seed + number, number % 2 == 0 ? NACRE_STANDARD : NACRE_PRECISE,
                 number % 8 == 0);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Documents, testing::Range(0, 4));

}  // namespace
}  // namespace nacre
