// What is beside islands, beside a search of all texels.
#include "examples/bake/dilate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace nacre::host {
namespace {

struct Map {
  std::size_t width, height;
  std::vector<std::vector<float>> planes;
  std::vector<std::uint8_t> covered;
};

Map random_map(std::size_t width, std::size_t height, double share, unsigned seed) {
  Map map{width, height, {}, {}};
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(1.0f, 2.0f);
  std::bernoulli_distribution is_covered(share);
  map.planes.resize(2);
  for (std::size_t i = 0; i < width * height; ++i) {
    map.covered.push_back(is_covered(random) ? 1 : 0);
    for (auto& plane : map.planes) plane.push_back(map.covered[i] != 0 ? unit(random) : 0.0f);
  }
  return map;
}

TEST(Dilate, TakesATexelThatIsNext) {
  for (const int reach : {1, 3, 9}) {
    Map map = random_map(41, 27, 0.01, 3);
    const Map before = map;
    dilate(map.planes, map.covered, 41, {reach, false});
    for (std::size_t i = 0; i < before.covered.size(); ++i) {
      const auto x = static_cast<int>(i % 41), y = static_cast<int>(i / 41);
      const auto is_near = [&](int dx, int dy) {
        return std::max(std::abs(dx), std::abs(dy)) <= reach;
      };
      int least = 1 << 20;
      for (std::size_t k = 0; k < before.covered.size(); ++k) {
        if (before.covered[k] == 0) continue;
        const int dx = static_cast<int>(k % 41) - x, dy = static_cast<int>(k / 41) - y;
        if (is_near(dx, dy)) least = std::min(least, dx * dx + dy * dy);
      }
      if (least == 1 << 20) {
        EXPECT_EQ(map.planes[0][i], 0.0f);
        continue;
      }
      bool is_next = false;
      for (std::size_t k = 0; k < before.covered.size(); ++k) {
        const int dx = static_cast<int>(k % 41) - x, dy = static_cast<int>(k / 41) - y;
        is_next =
            is_next ||
            (before.covered[k] != 0 && is_near(dx, dy) && dx * dx + dy * dy == least &&
             before.planes[0][k] == map.planes[0][i] && before.planes[1][k] == map.planes[1][i]);
      }
      EXPECT_TRUE(is_next) << x << ' ' << y;
    }
  }
}

/// The mean of a square is of islands alone at every mip level, and at the first that of its part
/// of them.
TEST(Dilate, FillsSoThatMeansAreOfIslandsAlone) {
  Map map = random_map(64, 64, 0.05, 4);
  const Map before = map;
  dilate(map.planes, map.covered, 64, {0, true});
  for (std::size_t side = 2; side <= 64; side *= 2) {
    for (std::size_t y = 0; y < 64; y += side) {
      for (std::size_t x = 0; x < 64; x += side) {
        double all = 0.0, own = 0.0;
        int count = 0;
        for (std::size_t j = y; j < y + side; ++j) {
          for (std::size_t i = x; i < x + side; ++i) {
            all += static_cast<double>(map.planes[0][64 * j + i]);
            if (before.covered[64 * j + i] == 0) continue;
            own += static_cast<double>(before.planes[0][64 * j + i]);
            ++count;
          }
        }
        // Islands are from 1 to 2 and the rest was 0.
        EXPECT_GE(all / static_cast<double>(side * side), 1.0 - 1e-6);
        EXPECT_LE(all / static_cast<double>(side * side), 2.0 + 1e-6);
        if (side > 2 || count == 0) continue;
        EXPECT_NEAR(all / 4, own / count, 1e-6);
      }
    }
  }
}

TEST(Dilate, WhatIsNoNumberStaysWhereItIs) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  Map map = random_map(9, 9, 0.0, 5);
  for (const std::size_t i : {20u, 60u}) map.covered[i] = 1;
  map.planes[0][20] = nan;
  map.planes[0][60] = 3.0f;
  dilate(map.planes, map.covered, 9, {2, true});
  for (std::size_t i = 0; i < 81; ++i) {
    if (i == 20) {
      EXPECT_TRUE(std::isnan(map.planes[0][i]));
    } else {
      EXPECT_EQ(map.planes[0][i], 3.0f) << i;
    }
  }
  // Nothing to take: all stays 0.
  Map none = random_map(5, 3, 0.0, 6);
  dilate(none.planes, none.covered, 5, {4, true});
  for (const float value : none.planes[0]) EXPECT_EQ(value, 0.0f);
}

}  // namespace
}  // namespace nacre::host
