#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/nodes/node_runner.h"

namespace nacre {
namespace {

std::vector<double> ramp(const char* category, const char* a, const char* b, float u, float v) {
  return call_node(category,
                   {{a, Type::vector2, {1, 10}},
                    {b, Type::vector2, {3, 20}},
                    {"texcoord", Type::vector2, {u, v}}},
                   Type::vector2);
}

TEST(Ramp, RunsFromLeftToRightAndBottomToTop) {
  EXPECT_EQ(ramp("ramplr", "valuel", "valuer", 0.25f, 0.9f), (std::vector<double>{1.5, 12.5}));
  EXPECT_EQ(ramp("ramplr", "valuel", "valuer", -4.0f, 0.9f), (std::vector<double>{1, 10}));
  EXPECT_EQ(ramp("ramptb", "valuet", "valueb", 0.9f, 0.25f), (std::vector<double>{2.5, 17.5}));
  EXPECT_EQ(ramp("ramptb", "valuet", "valueb", 0.9f, 7.0f), (std::vector<double>{1, 10}));
}

const NodeUnderTest split{"splitlr",
                          {{"valuel"}, {"valuer"}, {"center"}, {"texcoord", Type::vector2}}};

TEST(Split, IsAStepWithoutAFootprint) {
  const DoubleColumns out = run_node(split, {{"valuel", {2.0f}},
                                             {"valuer", {5.0f}},
                                             {"center", {0.5f}},
                                             {"texcoord.x", {0.0f, 0.5f, 0.50001f, 1.0f}}});
  EXPECT_EQ(out.at("out"), (std::vector<double>{2, 2, 5, 5}));
}

/// The box of the footprint's width in u: its share right of the edge.
TEST(Split, IsTheShareOfTheFootprintBehindTheEdge) {
  const DoubleColumns out =
      run_node(split, {{"valuel", {0.0f}},
                       {"valuer", {1.0f}},
                       {"center", {0.5f}},
                       {"texcoord.x", {0.375f, 0.4375f, 0.5f, 0.5625f, 0.625f}},
                       {"dtexcoorddx.x", {0.25f}}});
  const std::vector<double> expected{0, 0.25, 0.5, 0.75, 1};
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(out.at("out")[i], expected[i], 1e-12);
}

const NodeUnderTest height_node{
    "heighttonormal", {{"in"}, {"scale"}, {"texcoord", Type::vector2}}, {{"out", Type::vector3}}};

/// For a height with gradient g over uv: (-g s / 16, 1), normalized and encoded.
std::array<double, 3> encoded_normal(double gx, double gy, double scale) {
  const double x = -gx * scale / 16;
  const double y = -gy * scale / 16;
  const double length = std::sqrt(x * x + y * y + 1);
  return {x / length * 0.5 + 0.5, y / length * 0.5 + 0.5, 0.5 / length + 0.5};
}

TEST(HeightToNormal, DependsOnTheGradientOverUvOnly) {
  const std::array<double, 3> expected = encoded_normal(2.0, -3.0, 8.0);
  // Footprints of any size and shape over which h = 2 u - 3 v; the last mirrored.
  const float footprints[][4] = {{0.1f, 0, 0, 0.1f},
                                 {1e-12f, 0, 0, 1e-12f},
                                 {1e10f, 0, 0, 1e10f},
                                 {0.25f, 0.125f, -0.5f, 1},
                                 {0, 0.5f, 0.5f, 0}};
  for (const auto& f : footprints) {
    const DoubleColumns out = run_node(height_node, {{"scale", {8.0f}},
                                                     {"dindx", {2 * f[0] - 3 * f[1]}},
                                                     {"dindy", {2 * f[2] - 3 * f[3]}},
                                                     {"dtexcoorddx.x", {f[0]}},
                                                     {"dtexcoorddx.y", {f[1]}},
                                                     {"dtexcoorddy.x", {f[2]}},
                                                     {"dtexcoorddy.y", {f[3]}}});
    EXPECT_NEAR(out.at("out.x")[0], expected[0], 1e-6);
    EXPECT_NEAR(out.at("out.y")[0], expected[1], 1e-6);
    EXPECT_NEAR(out.at("out.z")[0], expected[2], 1e-6);
  }
}

TEST(HeightToNormal, IsFlatWithoutAFootprint) {
  const DoubleColumns out = run_node(height_node, {{"scale", {8.0f}}, {"in", {0.3f}}});
  EXPECT_EQ(out.at("out.x")[0], 0.5);
  EXPECT_EQ(out.at("out.y")[0], 0.5);
  EXPECT_EQ(out.at("out.z")[0], 1.0);
}

std::vector<double> mapped(const std::vector<float>& in,
                           const std::vector<float>& tangent = {1, 0, 0}) {
  return call_node("normalmap",
                   {{"in", Type::vector3, in},
                    {"scale", Type::vector2, {1, 2}},
                    {"normal", Type::vector3, {0, 0, 1}},
                    {"tangent", Type::vector3, tangent},
                    {"bitangent", Type::vector3, {0, 1, 0}}},
                   Type::vector3);
}

TEST(NormalMap, DecodesIntoTheFrame) {
  const std::vector<double> n = mapped({0.75f, 0.625f, 1.0f});
  const double length = std::sqrt(0.5 * 0.5 + 0.5 * 0.5 + 1.0);
  EXPECT_NEAR(n[0], 0.5 / length, 1e-7);
  EXPECT_NEAR(n[1], 0.5 / length, 1e-7);
  EXPECT_NEAR(n[2], 1.0 / length, 1e-7);
}

TEST(NormalMap, NoTexelIsTheNormal) {
  EXPECT_EQ(mapped({0, 0, 0}), (std::vector<double>{0, 0, 1}));
}

TEST(NormalMap, StraightensTheFrame) {
  const std::vector<double> straight = mapped({0.9f, 0.5f, 0.7f});
  const std::vector<double> leaning = mapped({0.9f, 0.5f, 0.7f}, {3, 0, 0.25f});
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(straight[k], leaning[k], 1e-7);
}

}  // namespace
}  // namespace nacre
