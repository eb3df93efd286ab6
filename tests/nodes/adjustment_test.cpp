#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "runtime/interpreter/interpreter.h"
#include "tests/nodes/node_runner.h"

namespace nacre {
namespace {

const float nan = std::numeric_limits<float>::quiet_NaN();

std::vector<double> colour(const char* category, const std::vector<float>& in) {
  return call_node(category, {{"in", Type::color3, in}}, Type::color3);
}

/// Foley, van Dam: the six sectors of the hexcone, for a hue in [0, 1).
std::array<double, 3> hexcone(double h, double s, double v) {
  const double sextant = h * 6.0;
  const int sector = static_cast<int>(sextant);
  const double f = sextant - sector;
  const double p = v * (1 - s);
  const double q = v * (1 - s * f);
  const double t = v * (1 - s * (1 - f));
  const std::array<std::array<double, 3>, 6> sectors{
      {{v, t, p}, {q, v, p}, {p, v, t}, {p, q, v}, {t, p, v}, {v, p, q}}};
  return sectors[static_cast<std::size_t>(sector)];
}

TEST(Hsv, IsTheHexcone) {
  for (int i = 0; i < 64; ++i) {
    for (const float s : {0.0f, 0.25f, 1.0f, 1.5f}) {
      const float h = static_cast<float>(i) / 64.0f;
      const std::array<double, 3> expected = hexcone(h, s, 0.75);
      const std::vector<double> ours = colour("hsvtorgb", {h, s, 0.75f});
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(ours[k], expected[k], 1e-12) << h << ' ' << s;
    }
  }
}

TEST(Hsv, HueWrapsWithoutASeam) {
  const auto kernel =
      make_interpreter(node_program({"hsvtorgb", {{"in", Type::color3}}, {{"out", Type::color3}}}));
  // The second rounds to a whole turn once its floor is taken off.
  const std::vector<float> hues{0.0f, -1e-9f, 1.0f, -3.0f, 7.0f};
  const Columns out = run(*kernel, {{"in.x", hues}, {"in.y", {1.0f}}, {"in.z", {1.0f}}});
  for (std::size_t i = 0; i < hues.size(); ++i) {
    EXPECT_EQ(out.at("out.x")[i], 1.0f) << hues[i];
    EXPECT_EQ(out.at("out.y")[i], 0.0f) << hues[i];
    EXPECT_NEAR(out.at("out.z")[i], 0.0f, 1e-6f) << hues[i];
  }
}

TEST(Hsv, RoundTripGivesTheColourBack) {
  for (const auto& rgb : std::vector<std::vector<float>>{{0.1f, 0.5f, 0.9f},
                                                         {0.9f, 0.1f, 0.5f},
                                                         {0.5f, 0.9f, 0.1f},
                                                         {1, 1, 1},
                                                         {0.2f, 0.2f, 0.200001f}}) {
    const std::vector<double> hsv = colour("rgbtohsv", rgb);
    const std::vector<double> back = colour("hsvtorgb", {hsv.begin(), hsv.end()});
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(back[k], rgb[k], 1e-6);
  }
}

TEST(Hsv, GreysAndBlacksHaveNoHue) {
  EXPECT_EQ(colour("rgbtohsv", {0.5f, 0.5f, 0.5f}), (std::vector<double>{0, 0, 0.5}));
  EXPECT_EQ(colour("rgbtohsv", {0, 0, 0}), (std::vector<double>{0, 0, 0}));
  const std::vector<double> negative = colour("rgbtohsv", {-1.0f, -0.5f, -2.0f});
  EXPECT_EQ(negative, (std::vector<double>{0, 0, -0.5}));
}

TEST(Luminance, WeighsTheChannelsAndKeepsAlpha) {
  const std::vector<double> out = call_node(
      "luminance",
      {{"in", Type::color4, {1, 2, 4, 0.25f}}, {"lumacoeffs", Type::color3, {0.5f, 0.25f, 0.125f}}},
      Type::color4);
  EXPECT_EQ(out, (std::vector<double>{1.5, 1.5, 1.5, 0.25}));
}

TEST(Remap, MovesOneRangeToAnother) {
  const auto remap = [](float x, float a, float b, float c, float d) {
    return call_scalar("remap",
                       {{"in", x}, {"inlow", a}, {"inhigh", b}, {"outlow", c}, {"outhigh", d}});
  };
  EXPECT_EQ(remap(3, 1, 5, 10, 30), 20.0);
  EXPECT_EQ(remap(9, 1, 5, 10, 30), 50.0);
  EXPECT_EQ(remap(7, 2, 2, 10, 30), 10.0);
  EXPECT_EQ(remap(3, 5, 1, 0, 1), 0.5);
}

TEST(Smoothstep, IsTheHermiteCubicBetweenSteps) {
  const auto smoothstep = [](float x, float low, float high) {
    return call_scalar("smoothstep", {{"in", x}, {"low", low}, {"high", high}});
  };
  EXPECT_EQ(smoothstep(2.5f, 2, 4), 0.25 * 0.25 * (3 - 0.5));
  EXPECT_EQ(smoothstep(1, 2, 4), 0.0);
  EXPECT_EQ(smoothstep(5, 2, 4), 1.0);
  EXPECT_EQ(smoothstep(2, 2, 2), 1.0);
  EXPECT_EQ(smoothstep(1.9f, 2, 2), 0.0);
  EXPECT_EQ(smoothstep(nan, 2, 4), 0.0);
}

}  // namespace
}  // namespace nacre
