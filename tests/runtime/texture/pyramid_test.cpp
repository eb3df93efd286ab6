#include "runtime/texture/pyramid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "runtime/texture/texel.h"

namespace nacre {
namespace {

using namespace texture_layout;
using Doubles = std::array<double, 4>;

struct Pyramid {
  Plan planned;
  std::vector<std::uint32_t> words;

  Rgba at(int level, int x, int y) const {
    return decode_texel(planned.format, &words[texel_index(planned, level, x, y)]);
  }
  int width(int level) const { return level_extent(planned.width, level); }
  int height(int level) const { return level_extent(planned.height, level); }
};

template <class Value>
Pyramid make(TexelFormat format, int width, int height, Value&& value) {
  Pyramid result{plan(format, width, height, 4), {}};
  result.words.resize(result.planned.total_words);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      encode_texel(format, value(x, y), &result.words[texel_index(result.planned, 0, x, y)]);
    }
  }
  build_pyramid(result.planned, result.words);
  return result;
}

Pyramid make_random(TexelFormat format, int width, int height) {
  std::mt19937 random(static_cast<unsigned>(width * 1000 + height));
  std::uniform_real_distribution<float> uniform(0.f, 1.f);
  return make(format, width, height, [&](int, int) {
    return Rgba{uniform(random), uniform(random), uniform(random), uniform(random)};
  });
}

double overlap(double a0, double a1, double b0, double b1) {
  return std::max(0.0, std::min(a1, b1) - std::max(a0, b0));
}

/// The next level by its definition: all texels, each by the share of area it covers.
std::vector<Doubles> area_average(const std::vector<Doubles>& fine, int fine_width, int fine_height,
                                  int width, int height) {
  std::vector<Doubles> result;
  const double sx = double(fine_width) / width;
  const double sy = double(fine_height) / height;
  for (int j = 0; j < height; ++j) {
    for (int i = 0; i < width; ++i) {
      Doubles sum{};
      for (int y = 0; y < fine_height; ++y) {
        for (int x = 0; x < fine_width; ++x) {
          const double area = overlap(x, x + 1, i * sx, (i + 1) * sx) *
                              overlap(y, y + 1, j * sy, (j + 1) * sy) / (sx * sy);
          const auto& texel = fine[static_cast<std::size_t>(y * fine_width + x)];
          for (std::size_t c = 0; c < 4; ++c) sum[c] += area * texel[c];
        }
      }
      result.push_back(sum);
    }
  }
  return result;
}

std::vector<Doubles> level_zero(const Pyramid& pyramid) {
  std::vector<Doubles> texels;
  for (int y = 0; y < pyramid.height(0); ++y) {
    for (int x = 0; x < pyramid.width(0); ++x) {
      const Rgba texel = pyramid.at(0, x, y);
      texels.push_back({texel[0], texel[1], texel[2], texel[3]});
    }
  }
  return texels;
}

constexpr std::array<std::pair<int, int>, 8> sizes{
    {{1, 1}, {1, 9}, {13, 1}, {3, 3}, {17, 5}, {32, 32}, {64, 8}, {31, 45}}};

/// Largest difference of any level from the chain of exact area averages.
double worst_difference(TexelFormat format) {
  double worst = 0;
  for (const auto& [width, height] : sizes) {
    const Pyramid pyramid = make_random(format, width, height);
    std::vector<Doubles> expected = level_zero(pyramid);
    for (int level = 1; level < pyramid.planned.levels; ++level) {
      expected = area_average(expected, pyramid.width(level - 1), pyramid.height(level - 1),
                              pyramid.width(level), pyramid.height(level));
      for (int y = 0; y < pyramid.height(level); ++y) {
        for (int x = 0; x < pyramid.width(level); ++x) {
          const Rgba texel = pyramid.at(level, x, y);
          const auto& exact = expected[static_cast<std::size_t>(y * pyramid.width(level) + x)];
          for (std::size_t c = 0; c < 4; ++c) {
            worst = std::max(worst, std::fabs(texel[c] - exact[c]));
          }
        }
      }
    }
  }
  return worst;
}

TEST(Pyramid, FloatLevelsAreTheAreaAverage) {
  // Two sums of at most three products a level, ten levels at most, values below 1.
  EXPECT_LT(worst_difference(TexelFormat::rgba32f), 10 * 4 * 0x1p-24);
}

TEST(Pyramid, IntegerLevelsAreRoundedOnceFromTheAreaAverage) {
  EXPECT_LT(worst_difference(TexelFormat::rgba8), 0.5 / 255 + 1e-5);
  EXPECT_LT(worst_difference(TexelFormat::rgba16), 0.5 / 65535 + 1e-5);
}

TEST(Pyramid, HalfLevelsAreRoundedOnceFromTheAreaAverage) {
  EXPECT_LT(worst_difference(TexelFormat::rgba16f), 0x1p-12 + 1e-5);
}

TEST(Pyramid, EveryLevelHasTheMeanOfTheImage) {
  for (const auto& [width, height] : sizes) {
    const Pyramid pyramid = make_random(TexelFormat::rgba32f, width, height);
    double first = 0;
    for (int level = 0; level < pyramid.planned.levels; ++level) {
      double mean = 0;
      for (int y = 0; y < pyramid.height(level); ++y) {
        for (int x = 0; x < pyramid.width(level); ++x) mean += pyramid.at(level, x, y)[0];
      }
      mean /= pyramid.width(level) * pyramid.height(level);
      if (level == 0) first = mean;
      EXPECT_NEAR(mean, first, 1e-6) << width << "x" << height << " level " << level;
    }
  }
}

TEST(Pyramid, PowerOfTwoLevelsAverageBlocksOfTheImage) {
  const Pyramid pyramid = make_random(TexelFormat::rgba32f, 32, 32);
  const std::vector<Doubles> image = level_zero(pyramid);
  for (int level = 1; level < 6; ++level) {
    const int side = 1 << level;
    for (int j = 0; j < 32 / side; ++j) {
      for (int i = 0; i < 32 / side; ++i) {
        double sum = 0;
        for (int k = 0; k < side * side; ++k) {
          const int x = i * side + k % side;
          const int y = j * side + k / side;
          sum += image[static_cast<std::size_t>(y * 32 + x)][1];
        }
        EXPECT_NEAR(pyramid.at(level, i, j)[1], sum / (side * side), 1e-6);
      }
    }
  }
}

TEST(Pyramid, ConstantByteImageStaysConstant) {
  for (const auto& [width, height] : sizes) {
    const Rgba value{3 * (1.f / 255.f), 128 * (1.f / 255.f), 254 * (1.f / 255.f), 1.f};
    const Pyramid pyramid =
        make(TexelFormat::rgba8, width, height, [&](int, int) { return value; });
    for (int level = 0; level < pyramid.planned.levels; ++level) {
      EXPECT_EQ(pyramid.at(level, 0, 0), value);
    }
  }
}

TEST(Pyramid, LargestFloatsStayFiniteAndTinyAveragesAreNotDenormal) {
  constexpr float largest = std::numeric_limits<float>::max();
  constexpr float smallest = std::numeric_limits<float>::min();
  const Pyramid pyramid = make(TexelFormat::rgba32f, 7, 7, [&](int x, int y) {
    return Rgba{largest, -largest, x + y == 0 ? smallest : 0.f, 1.f};
  });
  for (int level = 0; level < pyramid.planned.levels; ++level) {
    const Rgba texel = pyramid.at(level, 0, 0);
    EXPECT_TRUE(std::isfinite(texel[0]) && texel[0] > 0.99f * largest);
    EXPECT_TRUE(std::isfinite(texel[1]) && texel[1] < -0.99f * largest);
    EXPECT_NE(std::fpclassify(texel[2]), FP_SUBNORMAL);
  }
}

}  // namespace
}  // namespace nacre
