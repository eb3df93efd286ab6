// Recorded points: what is written is read, and what is none is refused.
#include "jit/tune/recorded_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace nacre {
namespace {

TEST(RecordedPoints, WhatIsWrittenIsReadToTheBit) {
  RecordedPoints points;
  const float least = std::numeric_limits<float>::denorm_min();
  points.add({"Gold", 3, {{"P.x", {0.1f, -least, 3e38f}}}, {{"id", {-1, 2147483647, 0}}}});
  points.add({"a \"name\"", 1, {{"uv0.x", {-0.0f}}}, {}});
  Diagnostics diagnostics;
  const auto read = RecordedPoints::parse(points.text(), "p.json", diagnostics);
  ASSERT_TRUE(read) << diagnostics.to_string();
  const PointsOfMaterial* const gold = read->find("Gold");
  ASSERT_NE(gold, nullptr);
  EXPECT_EQ(gold->count, 3u);
  EXPECT_EQ(gold->floats.at("P.x"), (std::vector{0.1f, -least, 3e38f}));
  EXPECT_EQ(gold->integers.at("id"), (std::vector{-1, 2147483647, 0}));
  ASSERT_NE(read->find("a \"name\""), nullptr);
  EXPECT_TRUE(std::signbit(read->find("a \"name\"")->floats.at("uv0.x")[0]));
  EXPECT_EQ(read->find("Silver"), nullptr);
}

class RecordedPointsBad : public ::testing::TestWithParam<const char*> {};

TEST_P(RecordedPointsBad, AreRefused) {
  Diagnostics diagnostics;
  EXPECT_FALSE(RecordedPoints::parse(GetParam(), "p.json", diagnostics));
  ASSERT_EQ(diagnostics.all().size(), 1u);
  EXPECT_EQ(diagnostics.all()[0].code, "bad-points");
  EXPECT_FALSE(diagnostics.all()[0].expected.empty());
  EXPECT_FALSE(diagnostics.all()[0].found.empty());
}

INSTANTIATE_TEST_SUITE_P(
    All, RecordedPointsBad,
    ::testing::Values(
        "", "[]", "{", "{}", R"({"nacre_points": 2, "materials": []})", R"({"nacre_points": 1})",
        R"({"nacre_points": 1, "materials": {}})", R"({"nacre_points": 1, "materials": [3]})",
        R"({"nacre_points": 1, "materials": [{"material": "M"}]})",
        R"({"nacre_points": 1, "materials": [{"material": "M", "count": -1}]})",
        R"({"nacre_points": 1, "materials": [{"material": "M", "count": 0}]})",
        R"({"nacre_points": 1, "materials": [{"material": "M", "count": 1, "channels": []}]})",
        R"({"nacre_points": 1, "materials": [{"material": "M", "count": 1,
            "channels": {"P.x": [1, 2]}}]})",
        R"({"nacre_points": 1, "materials": [{"material": "M", "count": 1,
            "channels": {"P.x": ["1"]}}]})",
        R"({"nacre_points": 1, "materials": [{"material": "M", "count": 1,
            "channels": {"P.x": [1e300]}}]})",
        R"({"nacre_points": 1, "materials": [{"material": "M", "count": 1,
            "integers": {"id": [1.5]}}]})",
        R"({"nacre_points": 1, "materials": [{"material": "M", "count": 1,
            "integers": {"id": [2147483648]}}]})",
        R"({"nacre_points": 1, "materials": [{"material": "M", "count": 1},
            {"material": "M", "count": 1}]})"));

}  // namespace
}  // namespace nacre
