// Tables that profiles are sampled by: refined angles, symmetries and integrals, by hand.
#include "pbs/profile/profile_tables.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace nacre {
namespace {

constexpr double pi_double = std::numbers::pi;

LightProfile profile(LightProfile::Type type, std::vector<float> vertical,
                     std::vector<float> horizontal, std::vector<float> intensity) {
  return {type, std::move(vertical), std::move(horizontal), std::move(intensity)};
}

TEST(ProfileTables, AnglesAreNoFurtherApartThanTenDegrees) {
  const ProfileTables tables =
      make_profile_tables(profile(LightProfile::Type::c, {0, 35, 180}, {0}, {0, 7, 7}));
  for (const float angle : {0.0f, 35.0f, 90.0f, 180.0f}) {
    EXPECT_TRUE(std::ranges::count(tables.vertical, angle) == 1) << angle;
  }
  for (std::size_t i = 1; i < tables.vertical.size(); ++i) {
    EXPECT_LE(tables.vertical[i] - tables.vertical[i - 1], 10.0f + 1e-4f);
    EXPECT_GE(tables.below[i], tables.below[i - 1]);
  }
  // 35 degrees in four steps: linear between those measured.
  EXPECT_FLOAT_EQ(tables.vertical[1], 8.75f);
  EXPECT_FLOAT_EQ(tables.intensity[1], 1.75f);
}

// Intensity 1 over a hemisphere: the integral of cos + 1/8 is pi + 2 pi / 8, and as much by any
// symmetry; over the sphere twice that.
TEST(ProfileTables, TotalIsTheIntegralOfTheDensity) {
  const double half = pi_double * 1.25;
  EXPECT_NEAR(make_profile_tables(profile(LightProfile::Type::c, {0, 90}, {0}, {1, 1})).total, half,
              1e-6);
  EXPECT_NEAR(make_profile_tables(profile(LightProfile::Type::c, {0, 180}, {0}, {1, 1})).total,
              2 * half, 1e-6);
  for (const float last : {90.0f, 180.0f, 360.0f}) {
    EXPECT_NEAR(
        make_profile_tables(profile(LightProfile::Type::c, {0, 90}, {0, last}, {1, 1, 1, 1})).total,
        half, 1e-6);
  }
  EXPECT_NEAR(
      make_profile_tables(profile(LightProfile::Type::c, {0, 90}, {90, 270}, {1, 1, 1, 1})).total,
      half, 1e-6);
}

// Over latitude and longitude of half a sphere the integral of cos (cos + 1/8) is pi/2 + 1/4, that
// of cos + 1/8 is 2 + pi/8.
TEST(ProfileTables, TotalOfFloodlightsIsTheIntegralOfTheirs) {
  const double all = (pi_double / 2 + 0.25) * (2 + pi_double / 8);
  for (const LightProfile::Type type : {LightProfile::Type::a, LightProfile::Type::b}) {
    for (const float v : {0.0f, -90.0f}) {
      for (const float h : {0.0f, -90.0f}) {
        EXPECT_NEAR(make_profile_tables(profile(type, {v, 90}, {h, 90}, {1, 1, 1, 1})).total, all,
                    1e-6)
            << v << " " << h;
      }
    }
  }
}

TEST(ProfileTables, DarkOnesHaveNone) {
  const ProfileTables tables =
      make_profile_tables(profile(LightProfile::Type::b, {0, 90}, {0, 90}, {0, 0, 0, 0}));
  EXPECT_EQ(tables.total, 0.0);
}

TEST(ProfileTables, MirrorsAreThoseOfTheStandard) {
  const auto mirrors = [](LightProfile::Type type, float v, float first, float last) {
    const Mirrors found = mirrors_of(profile(type, {v, 90}, {first, last}, {1, 1, 1, 1}));
    return (found.x ? 1 : 0) + (found.y ? 2 : 0);
  };
  EXPECT_EQ(mirrors(LightProfile::Type::c, 0, 0, 90), 3);
  EXPECT_EQ(mirrors(LightProfile::Type::c, 0, 0, 180), 2);
  EXPECT_EQ(mirrors(LightProfile::Type::c, 0, 90, 270), 1);
  EXPECT_EQ(mirrors(LightProfile::Type::c, 0, 0, 360), 0);
  EXPECT_EQ(mirrors(LightProfile::Type::b, 0, -90, 90), 2);
  EXPECT_EQ(mirrors(LightProfile::Type::a, -90, 0, 90), 1);
  EXPECT_EQ(mirrors(LightProfile::Type::a, 0, 0, 90), 3);
}

}  // namespace
}  // namespace nacre
