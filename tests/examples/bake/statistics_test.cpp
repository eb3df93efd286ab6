// Ranges, means and histograms of planes, by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "examples/bake/texel_statistics.h"

namespace nacre::host {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

TEST(TexelStatisticsTest, OfARamp) {
  std::vector<std::vector<float>> planes(1);
  for (int i = 0; i < 1000; ++i) planes[0].push_back(static_cast<float>(i) / 64.0f - 1.0f);
  const TexelStatistics statistics = statistics_of(planes, {true, 0.0f, 1.0f});
  const ChannelStatistics& channel = statistics.channels[0];
  EXPECT_EQ(statistics.texels, 1000u);
  EXPECT_EQ(channel.least, -1.0f);
  EXPECT_EQ(channel.most, 999.0f / 64.0f - 1.0f);
  EXPECT_DOUBLE_EQ(channel.mean(), 999.0 / 128.0 - 1.0);
  EXPECT_EQ(channel.histogram.front(), 64u);
  for (std::size_t i = 1; i < 32; ++i) EXPECT_EQ(channel.histogram[i], 2u);
  EXPECT_EQ(channel.histogram[32], 3u);  // And 1 itself.
  EXPECT_EQ(channel.histogram.back(), 1000u - 64u - 65u);
  EXPECT_FALSE(statistics.is_uniform());
}

TEST(TexelStatisticsTest, CountsWhatIsNoNumber) {
  const std::vector<std::vector<float>> planes{{1.0f, NAN, infinity, -infinity, 3.0f}};
  const ChannelStatistics channel = statistics_of(planes, {true, 0.0f, 1.0f}).channels[0];
  EXPECT_EQ(channel.least, -infinity);
  EXPECT_EQ(channel.most, infinity);
  EXPECT_EQ(channel.finite, 2u);
  EXPECT_EQ(channel.unbounded, 2u);
  EXPECT_EQ(channel.no_number, 1u);
  EXPECT_DOUBLE_EQ(channel.mean(), 2.0);
}

TEST(TexelStatisticsTest, PartsAddUp) {
  TexelStatistics all;
  all.add(statistics_of(std::vector<std::vector<float>>{{2.0f, 2.0f}}, {}));
  EXPECT_TRUE(all.is_uniform());
  all.add(statistics_of(std::vector<std::vector<float>>{{2.0f, 5.0f}}, {}));
  EXPECT_FALSE(all.is_uniform());
  EXPECT_EQ(all.texels, 4u);
  EXPECT_EQ(all.channels[0].most, 5.0f);
  EXPECT_DOUBLE_EQ(all.channels[0].mean(), 2.75);
}

}  // namespace
}  // namespace nacre::host
