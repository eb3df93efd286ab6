// Constant textures: what OpenGL 4.6 says of filters and edges (core profile, 8.14.2).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "jit/record/sample_table.h"
#include "tests/support/run_kernel.h"

namespace nacre {
namespace {

TextTable table(std::array<std::size_t, 3> size, std::size_t channels, TextTable::Filter filter,
                std::vector<float> values) {
  return {"t", size, channels, filter, std::make_shared<TableValues>(std::move(values))};
}

/// The four components at places (x, y, z), in double precision.
std::array<std::vector<double>, 4> sample(const TextTable& table, std::size_t axes,
                                          const Columns& places) {
  EXPECT_TRUE(is_whole(table));
  const auto columns = evaluate(places, [&](Recorder& recorder) {
    std::vector<Float> place;
    for (std::size_t i = 0; i < axes; ++i) {
      place.push_back(input(recorder, std::string(1, "xyz"[i])));
    }
    const auto texel = sample_table(recorder, table, add_table(recorder, table), place);
    std::vector<SliceOutput> outputs;
    for (std::size_t k = 0; k < 4; ++k)
      outputs.push_back({std::string(1, "rgba"[k]), texel[k].ref()});
    return outputs;
  });
  return {columns.at("r"), columns.at("g"), columns.at("b"), columns.at("a")};
}

/// A polynomial linear in each axis is its own interpolation.
TEST(TextTables, LinearFiltersReproduceTrilinearFunctions) {
  const std::array<std::size_t, 3> size{4, 3, 5};
  const auto f = [](double x, double y, double z, std::size_t k) {
    const auto c = static_cast<double>(k);
    return 1 + c + 2 * x - y + 0.5 * z + 0.25 * c * x * y - x * z + 0.125 * x * y * z;
  };
  std::vector<float> values;
  for (std::size_t z = 0; z < size[2]; ++z) {
    for (std::size_t y = 0; y < size[1]; ++y) {
      for (std::size_t x = 0; x < size[0]; ++x) {
        for (std::size_t k = 0; k < 3; ++k) {
          values.push_back(static_cast<float>(f(double(x), double(y), double(z), k)));
        }
      }
    }
  }
  Columns places;
  for (int i = 0; i < 1000; ++i) {
    // From outside one edge to outside the other.
    places["x"].push_back(-0.25f + 1.5f * static_cast<float>(i % 10) / 9);
    places["y"].push_back(-0.25f + 1.5f * static_cast<float>(i / 10 % 10) / 9);
    places["z"].push_back(-0.25f + 1.5f * static_cast<float>(i / 100) / 9);
  }
  const auto found = sample(table(size, 3, TextTable::Filter::linear, values), 3, places);
  for (std::size_t i = 0; i < 1000; ++i) {
    std::array<double, 3> at{places["x"][i], places["y"][i], places["z"][i]};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto count = static_cast<double>(size[axis]);
      at[axis] = std::clamp(at[axis] * count - 0.5, 0.0, count - 1);
    }
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(found[k][i], f(at[0], at[1], at[2], k), 1e-12);
    EXPECT_EQ(found[3][i], 1.0);
  }
}

TEST(TextTables, NearestFiltersTakeTheTexelAround) {
  std::vector<float> values;
  for (int i = 0; i < 4 * 2 * 4; ++i) values.push_back(static_cast<float>(i));
  const Columns places{{"x", {-1.0f, 0.0f, 0.24f, 0.26f, 0.74f, 0.99f, 1.0f, 7.0f}},
                       {"y", {0.1f, 0.49f, 0.51f, 0.9f, 2.0f, -1.0f, 0.75f, 0.25f}}};
  const std::vector<int> texels{0, 0, 4, 5, 6, 3, 7, 3};
  const auto found = sample(table({4, 2, 1}, 4, TextTable::Filter::nearest, values), 2, places);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_EQ(found[k][i], 4 * texels[i] + static_cast<int>(k)) << i;
    }
  }
}

TEST(TextTables, EveryNumberOfChannelsAndOneTexel) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const Columns places{{"x", {0.5f, -infinity, infinity, std::numeric_limits<float>::quiet_NaN()}}};
  for (std::size_t channels = 1; channels <= 4; ++channels) {
    std::vector<float> values{3, 5, 7, 9};
    values.resize(channels);
    for (const auto filter : {TextTable::Filter::nearest, TextTable::Filter::linear}) {
      const auto found = sample(table({1, 1, 1}, channels, filter, values), 1, places);
      for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(found[0][i], 3);
        EXPECT_EQ(found[1][i], channels > 1 ? 5 : 0);
        EXPECT_EQ(found[2][i], channels > 2 ? 7 : 0);
        EXPECT_EQ(found[3][i], channels > 3 ? 9 : 1);
      }
    }
  }
  // The first texel for no number, the edges for infinities.
  const auto found = sample(table({3, 1, 1}, 1, TextTable::Filter::linear, {1, 2, 4}), 1, places);
  EXPECT_EQ(found[0], (std::vector<double>{2, 1, 4, 1}));
}

TEST(TextTables, WholeOnesHaveTheirNumbers) {
  const auto linear = TextTable::Filter::linear;
  EXPECT_TRUE(is_whole(table({2, 1, 1}, 3, linear, std::vector<float>(6))));
  EXPECT_FALSE(is_whole(table({2, 1, 1}, 3, linear, std::vector<float>(5))));
  EXPECT_FALSE(is_whole(table({0, 1, 1}, 3, linear, {})));
  EXPECT_FALSE(is_whole(table({1, 1, 1}, 5, linear, std::vector<float>(5))));
  const std::size_t huge = std::numeric_limits<std::size_t>::max() / 2 + 1;
  EXPECT_FALSE(is_whole(table({huge, 2, 1}, 1, linear, {})));
  EXPECT_FALSE(is_whole({"t", {1, 1, 1}, 1, linear, nullptr}));
  EXPECT_NE(TableValues({0.0f}).digest(), TableValues({-0.0f}).digest());
}

}  // namespace
}  // namespace nacre
