#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "examples/image_input/level.h"
#include "tests/examples/image_input/image_fixture.h"

namespace graph_image {
namespace {

using GraphImageLevels = GraphImages;

Request of_size(int width, int height, int samples) {
  Request request;
  request.width = width;
  request.height = height;
  request.samples = samples;
  return request;
}

/// u^2, whose mean over n points in the middles of as many parts is 1/3 - 1/(12 n^2).
std::string parabola() {
  return document_of(R"(<texcoord name="uv" type="vector2" />
<multiply name="square" type="vector2">
  <input name="in1" type="vector2" nodename="uv" /><input name="in2" type="vector2" nodename="uv" />
</multiply>
<output name="out" type="vector2" nodename="square" />)");
}

std::string checkers() {
  return document_of(R"(<texcoord name="uv" type="vector2" />
<checkerboard name="checkers" type="color3">
  <input name="color1" type="color3" value="1, 0.5, 0" />
  <input name="color2" type="color3" value="0, 0.25, 0" />
  <input name="uvtiling" type="vector2" value="8, 8" />
  <input name="texcoord" type="vector2" nodename="uv" />
</checkerboard>
<output name="out" type="color3" nodename="checkers" />)");
}

double mean(const std::vector<float>& texels, std::size_t channels, std::size_t channel) {
  double sum = 0;
  for (std::size_t i = channel; i < texels.size(); i += channels) {
    sum += static_cast<double>(texels[i]);
  }
  return sum * static_cast<double>(channels) / static_cast<double>(texels.size());
}

TEST(GraphImageLevel, HalvesUntilOneTexelIsLeft) {
  EXPECT_EQ(level_count(1, 1), 1);
  EXPECT_EQ(level_count(64, 64), 7);
  EXPECT_EQ(level_count(65536, 1), 17);
  EXPECT_EQ(level_count(100, 37), 7);
  const Request request = of_size(100, 37, 8);
  EXPECT_EQ(level_of(request, 3).width, 12);
  EXPECT_EQ(level_of(request, 3).height, 4);
  EXPECT_EQ(level_of(request, 6).width, 1);
  EXPECT_EQ(level_of(request, 6).height, 1);
}

TEST(GraphImageLevel, HasAsManyPointsAsTheFinestHasTexelsThere) {
  const Request request = of_size(4096, 64, 8);
  for (int k = 0; k <= 12; ++k) {
    const Level level = level_of(request, k);
    EXPECT_EQ(level.samples_x, std::min(1 << k, 8)) << k;
    EXPECT_EQ(level.samples_y, std::min(64 / level.height, 8)) << k;
  }
}

TEST_F(GraphImageLevels, MeansAreThoseOfTheirPoints) {
  const auto image = open(write("parabola.mtlx", parabola()) + "?size=64");
  ASSERT_NE(image, nullptr);
  for (int k = 0; k <= 6; ++k) {
    const int points = std::min(64, (64 >> k) * 8);  // On a side.
    const double expected = 1.0 / 3 - 1.0 / (12.0 * points * points);
    const std::vector<float> texels = read(*image, k);
    EXPECT_NEAR(mean(texels, 2, 0), expected, 1e-7) << k;
    EXPECT_NEAR(mean(texels, 2, 1), expected, 1e-7) << k;
  }
}

TEST_F(GraphImageLevels, AreTheBoxAverageWhileTheirPointsSuffice) {
  const auto image = open(marble_ + "?output=NG_marble/base_color&size=128");
  ASSERT_NE(image, nullptr);
  const std::vector<float> finest = read(*image, 0);
  for (int k = 1; k <= 3; ++k) {
    const std::vector<float> texels = read(*image, k);
    const std::size_t side = std::size_t{128} >> k, across = std::size_t{1} << k;
    ASSERT_EQ(texels.size(), side * side * 3);
    for (std::size_t i = 0; i < texels.size(); ++i) {
      const std::size_t x = i / 3 % side, y = i / 3 / side;
      double sum = 0;
      for (std::size_t b = y * across; b < (y + 1) * across; ++b) {
        for (std::size_t a = x * across; a < (x + 1) * across; ++a) {
          sum += static_cast<double>(finest[(b * 128 + a) * 3 + i % 3]);
        }
      }
      ASSERT_EQ(texels[i], static_cast<float>(sum / static_cast<double>(across * across)))
          << k << " " << i;
    }
  }
}

TEST_F(GraphImageLevels, TheCoarsestOfCheckersIsTheirCoverage) {
  const std::string file = write("checkers.mtlx", checkers());
  for (const char* size : {"64", "256", "65536"}) {
    const auto image = open(file + "?size=" + size);
    ASSERT_NE(image, nullptr);
    EXPECT_EQ(read(*image, level_count(std::stoi(size), 1) - 1),
              (std::vector<float>{0.5f, 0.375f, 0.0f}));
  }
  // Every texel of the finest is of one field.
  for (const float green : read(file + "?size=64")) {
    EXPECT_TRUE(green == 0.0f || green == 1.0f || green == 0.5f || green == 0.25f) << green;
  }
}

TEST_F(GraphImageLevels, OnePointATexelIsTheGraphAtThatResolution) {
  const std::string file = write("ramp.mtlx", ramp());
  const auto coarse = open(file + "?size=64&samples=1");
  ASSERT_NE(coarse, nullptr);
  EXPECT_EQ(read(*coarse, 2), read(file + "?size=16"));
}

TEST_F(GraphImageLevels, ImagesAreFilteredByTheirNodes) {
  // Stripes of one texel: what their node gives for the footprint of a coarse texel is their mean.
  OIIO::ImageSpec spec(64, 64, 1, OIIO::TypeDesc::FLOAT);
  std::vector<float> stripes(64 * 64);
  for (std::size_t i = 0; i < stripes.size(); ++i) stripes[i] = static_cast<float>(i % 2);
  const auto out = OIIO::ImageOutput::create("exr");
  ASSERT_NE(out, nullptr);
  ASSERT_TRUE(out->open(folder_.file("stripes.exr"), spec));
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, stripes.data()));
  out->close();
  const auto image = open(write("stripes.mtlx", document_of(R"(<image name="image" type="float">
  <input name="file" type="filename" value="stripes.exr" />
</image>
<output name="out" type="float" nodename="image" />)")) +
                          "?size=64&samples=1");
  ASSERT_NE(image, nullptr);
  for (int k = 3; k <= 6; ++k) {
    for (const float texel : read(*image, k)) EXPECT_NEAR(texel, 0.5f, 1e-3f) << k;
  }
}

}  // namespace
}  // namespace graph_image
