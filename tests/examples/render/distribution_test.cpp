#include "examples/render/distribution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace nacre::host {
namespace {

/// Weights of `count` intervals, many of them 0, some far above the rest.
std::vector<double> weights(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<double> made;
  for (std::size_t i = 0; i < count; ++i) {
    const unsigned kind = random() % 8;
    made.push_back(kind < 3 ? 0.0 : kind == 7 ? 1e6 : 1.0 + static_cast<double>(random() % 100));
  }
  made[count / 2] = 1.0;  // Not all 0.
  return made;
}

// The interval is what a search among the running sums finds, and none that is 0 wide.
TEST(Distribution, ChoosesWhatASearchFinds) {
  for (const std::size_t count : {1u, 2u, 3u, 4u, 5u, 7u, 64u, 1000u, 4097u}) {
    for (unsigned seed = 0; seed < 8; ++seed) {
      const std::vector<double> given = weights(count, seed);
      const Distribution distribution(given);
      std::vector<double> edges{0.0};
      for (const double w : given) edges.push_back(edges.back() + w);
      std::mt19937 random(seed + 99);
      for (int i = 0; i < 4000; ++i) {
        const float u = i == 0   ? 0.f
                        : i == 1 ? 0x1.fffffep-1f
                        : i == 2 ? 1.f  // What an arithmetic that rounds may give.
                                 : static_cast<float>(random() >> 8) * 0x1p-24f;
        const auto [interval, within] = distribution.choose(u);
        const auto at = static_cast<std::size_t>(interval);
        ASSERT_LT(at, count);
        ASSERT_GT(distribution.probability(interval), 0.f) << count << " u = " << u;
        ASSERT_TRUE(within >= 0.f && within < 1.f);
        // In double: off by the rounding of an edge to float.
        const double place = double{u} * edges.back();
        ASSERT_GE(place, edges[at] - 1e-7 * edges.back());
        ASSERT_LE(place, edges[at + 1] + 1e-7 * edges.back());
      }
    }
  }
}

TEST(Distribution, OfNothingHasNoInterval) {
  const Distribution distribution({0.0, 0.0, 0.0});
  EXPECT_EQ(distribution.sum(), 0.0);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(distribution.probability(i), 0.f);
  for (const float u : {0.f, 0.5f, 1.f}) EXPECT_LT(distribution.choose(u).interval, 3);
}

}  // namespace
}  // namespace nacre::host
