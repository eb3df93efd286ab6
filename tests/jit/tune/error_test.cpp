// How far off numbers are, by numbers worked out by hand.
#include "jit/tune/error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nacre {
namespace {

constexpr float nan_value = NAN;

TEST(TuneError, IsRelativeToTheNumberAndToAShareOfTheLargest) {
  const Columns exact{{"f.x", {10, 1, 0}}, {"f.y", {0, 0, 0.05f}}};
  const Columns found{{"f.x", {10.5f, 1, 0.002f}}, {"f.y", {0, 0.01f, 0.05f}}};
  const Error error = error_of(found, exact, {.is_relative = true, .floor = 0.01});
  // Of .5 in 10; the floor is .1, the largest of both components being 10: .01 / .1.
  EXPECT_NEAR(error.maximum, 0.1, 1e-6);
  EXPECT_EQ(error.worst, "f.y");
  EXPECT_EQ(error.worst_point, 1u);
  EXPECT_NEAR(error.mean, (0.05 + 0.02 + 0.1) / 6, 1e-6);
}

TEST(TuneError, IsTheDifferenceWhereItIsAbsolute) {
  const Error error =
      error_of({{"out", {10.5f, 1}}}, {{"out", {10, 1}}}, {.is_relative = false, .floor = 0});
  EXPECT_EQ(error.maximum, 0.5);
  EXPECT_EQ(error.mean, 0.25);
}

TEST(TuneError, OneOfAThousandMayBeLarger) {
  std::vector<float> exact(2000, 1), found(2000, 1);
  found[3] = found[4] = 1.5f;
  for (int i = 5; i < 8; ++i) found[static_cast<std::size_t>(i)] = 1.25f;
  const Error error = error_of({{"out", found}}, {{"out", exact}}, {});
  EXPECT_EQ(error.maximum, 0.5);
  EXPECT_EQ(error.p999, 0.25);  // Two of the two thousand exceed it.
}

TEST(TuneError, WhatIsNotFiniteIsInfinitelyFarOffOrCountsForNothing) {
  const Error lost = error_of({{"out", {nan_value, 1}}}, {{"out", {1, 1}}}, {});
  EXPECT_TRUE(std::isinf(lost.maximum));
  const Error same = error_of({{"out", {5, 1}}}, {{"out", {nan_value, 1}}}, {});
  EXPECT_EQ(same.maximum, 0);
  const Error infinite = error_of({{"out", {INFINITY}}}, {{"out", {INFINITY}}}, {});
  EXPECT_EQ(infinite.maximum, 0);
}

TEST(TuneError, OfChannelsThatAreNotThereIsInfinite) {
  EXPECT_TRUE(std::isinf(error_of({}, {{"out", {1}}}, {}).maximum));
}

TEST(TuneError, OfNothingIsNone) {
  EXPECT_EQ(error_of({{"out", {1}}}, {{"out", {nan_value}}}, {}).p999, 0);
}

}  // namespace
}  // namespace nacre
