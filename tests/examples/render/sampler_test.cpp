#include "examples/render/sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace nacre::host {
namespace {

SampleKey key(std::uint32_t pixel, std::uint32_t sample, std::uint32_t event = 0) {
  return {7u, pixel, sample, event};
}

// Sobol' 1967: a (0,2)-sequence in base 2 has one of every 2^m consecutive
// points in each elementary interval of area 2^-m; Owen scrambling keeps that.
TEST(Sampler, EveryElementaryIntervalHoldsOnePoint) {
  for (const std::uint32_t pixel : {0u, 1u, 12345u}) {
    for (int m = 0; m <= 8; ++m) {
      for (int a = 0; a <= m; ++a) {
        std::set<int> cells;
        for (std::uint32_t i = 0; i < (1u << m); ++i) {
          const Uniform2 u = uniform2(SamplerKind::sobol, key(pixel, i), Draw::light);
          cells.insert((static_cast<int>(std::ldexp(u.x, a)) << (m - a)) |
                       static_cast<int>(std::ldexp(u.y, m - a)));
        }
        EXPECT_EQ(cells.size(), std::size_t{1} << m) << "pixel " << pixel << " a " << a;
      }
    }
  }
}

// Points for different purposes must not be correlated: over many samples the
// covariance of two purposes' numbers is that of independent ones.
TEST(Sampler, PurposesAndEventsAreUncorrelated) {
  constexpr int n = 1 << 14;
  for (const SamplerKind kind : {SamplerKind::sobol, SamplerKind::independent}) {
    for (const auto& [draw, event] : {std::pair{Draw::lobe, 0u}, std::pair{Draw::direction, 1u}}) {
      double sum = 0;
      for (int i = 0; i < n; ++i) {
        // One sample from each of many pixels: then the numbers of a pair are random.
        const auto pixel = static_cast<std::uint32_t>(i);
        const double a = uniform2(kind, key(pixel, 3), Draw::direction).x - 0.5;
        const double b = uniform2(kind, key(pixel, 3, event), draw).x - 0.5;
        sum += a * b;
      }
      // Variance of the product of two centred uniforms: 1/144.
      EXPECT_LT(std::abs(sum / n), 4.5 / 12 / std::sqrt(double{n}));
    }
  }
}

TEST(Sampler, NumbersAreBelowOne) {
  for (const SamplerKind kind : {SamplerKind::sobol, SamplerKind::independent}) {
    for (std::uint32_t i = 0; i < 20000; ++i) {
      const Uniform2 u = uniform2(kind, key(i % 7, i), Draw::pixel);
      ASSERT_TRUE(u.x >= 0.f && u.x < 1.f && u.y >= 0.f && u.y < 1.f);
    }
  }
}

// What several lanes make is what one makes, at every length of the last block.
TEST(Sampler, ManyAreTheSameAsOneByOne) {
  for (const SamplerKind kind : {SamplerKind::sobol, SamplerKind::independent}) {
    for (const std::size_t count : {0u, 1u, 7u, 63u, 64u, 65u, 1000u}) {
      std::vector<SampleKey> keys;
      for (std::uint32_t i = 0; i < count; ++i) {
        keys.push_back({i * 0x9e3779b9u, i ^ 0xfffffff0u, i * i, i % 9, i % 3});
      }
      std::vector<Uniform2> numbers(count);
      uniform2(kind, keys, Draw::direction, numbers);
      for (std::size_t i = 0; i < count; ++i) {
        const Uniform2 one = uniform2(kind, keys[i], Draw::direction);
        ASSERT_EQ(numbers[i].x, one.x) << i << " of " << count;
        ASSERT_EQ(numbers[i].y, one.y) << i << " of " << count;
      }
    }
  }
}

TEST(Sampler, SeedChangesEveryNumber) {
  int same = 0;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    SampleKey a = key(5, i), b = a;
    b.seed ^= 1;
    same += uniform2(SamplerKind::sobol, a, Draw::lens).x ==
            uniform2(SamplerKind::sobol, b, Draw::lens).x;
  }
  EXPECT_LE(same, 2);
}

}  // namespace
}  // namespace nacre::host
