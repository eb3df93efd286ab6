// The sweeps of composites and documents, whole and with other numbers each day.
#include <gtest/gtest.h>
#include <nacre/nacre.h>

#include "tests/pbs/battery/composite_trial.h"
#include "tests/pbs/battery/document_trial.h"

namespace nacre {
namespace {

class CompositesWhole : public testing::TestWithParam<Composite> {};

// NACRE_TEST_POINTS is how many configurations a row has.
TEST_P(CompositesWhole, KeepTheLawsOfLobes) { try_composite(GetParam(), whole_tier()); }

INSTANTIATE_TEST_SUITE_P(All, CompositesWhole,
                         testing::ValuesIn(composites().begin(), composites().end()),
                         [](const auto& instance) { return instance.param.name; });

class DocumentsWhole : public testing::TestWithParam<int> {};

// Two thousand a night, in parts. NACRE_TEST_POINTS is how many a part has.
TEST_P(DocumentsWhole, SpecialisedAreAsGeneralOnes) {
  const Tier tier = whole_tier();
  const std::uint64_t all = number_of("NACRE_TEST_POINTS", 200);
  const std::uint64_t first = tier.seed + all * static_cast<std::uint64_t>(GetParam());
  for (std::uint64_t i = 0; i < all; ++i) {
    try_document(first + i, i % 2 == 0 ? NACRE_STANDARD : NACRE_PRECISE, i % 4 < 2);
  }
}

INSTANTIATE_TEST_SUITE_P(All, DocumentsWhole, testing::Range(0, 10));

}  // namespace
}  // namespace nacre
