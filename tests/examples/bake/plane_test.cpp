// What the plane says of points in texels.
#include "examples/bake/plane.h"

#include <gtest/gtest.h>

namespace nacre::host {
namespace {

std::vector<float> values(const Plane& plane, std::string_view channel, const TexelPoints& points) {
  std::vector<float> filled;
  plane.fill(channel, points, filled);
  return filled;
}

TEST(BakePlane, TexelsHaveTheirMiddle) {
  const Plane plane(8, 4, {.u = 2, .v = 1});
  const TexelPoints points{{0.5f, 7.5f}, {0.5f, 3.5f}};
  EXPECT_EQ(values(plane, "uv0.x", points), (std::vector<float>{2.0625f, 2.9375f}));
  EXPECT_EQ(values(plane, "uv3.y", points), (std::vector<float>{1.875f, 1.125f}));
  EXPECT_EQ(values(plane, "P.z", points), (std::vector<float>{0.0f, 0.0f}));
  EXPECT_EQ(values(plane, "N.z", points), (std::vector<float>{1.0f, 1.0f}));
}

// Four texels side by side over a quarter of what is to the right of u = 3.
TEST(BakePlane, AWindowIsAllThatAnImageShows) {
  const Plane plane(4, 2, {.u = 3, .v = -1, .width = 0.25f, .height = 2});
  const TexelPoints points{{0.5f, 3.5f}, {0.5f, 1.5f}};
  EXPECT_EQ(values(plane, "uv0.x", points), (std::vector<float>{3.03125f, 3.21875f}));
  EXPECT_EQ(values(plane, "Po.y", points), (std::vector<float>{0.5f, -0.5f}));
  EXPECT_EQ(values(plane, "duv0dx.x", points)[0], 0.0625f);
  EXPECT_EQ(values(plane, "dPdy.y", points)[0], -1.0f);
}

// Of the distance between samples: a quarter of a texel where there are sixteen.
TEST(BakePlane, FootprintsAreAsWideAsTheySay) {
  const Plane plane(8, 4);
  const TexelPoints points{{0.5f}, {0.5f}, 0.25f};
  EXPECT_EQ(values(plane, "duv0dx.x", points)[0], 0.25f / 8.0f);
  EXPECT_EQ(values(plane, "duv0dy.y", points)[0], -0.25f / 4.0f);
  EXPECT_EQ(values(plane, "dPdx.x", points)[0], 0.25f / 8.0f);
  EXPECT_EQ(values(plane, "dPody.y", points)[0], -0.25f / 4.0f);
  EXPECT_EQ(values(plane, "duv0dx.y", points)[0], 0.0f);
}

}  // namespace
}  // namespace nacre::host
